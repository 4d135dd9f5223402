#include "service/sph/description_hash.h"

#include <bit>
#include <string>
#include <type_traits>

namespace bleedsim::sph {
namespace {

/// Each add() takes one field; optional fields and variants tell which they are.
class FieldHash {
 public:
  std::uint64_t value() const { return hash_; }

  template <class T>
  void add(const T& field) {
    if constexpr (std::is_floating_point_v<T>) {
      mix(std::bit_cast<std::uint64_t>(static_cast<double>(field)));
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      mix(static_cast<std::uint64_t>(field));
    } else {
      addFields(field);
    }
  }

 private:
  void mix(std::uint64_t word) { hash_ = std::rotl(hash_ ^ (word * 0xd6e8feb86659fd93ull), 29) * 0x9e3779b97f4a7c15ull; }

  template <class T>
  void addFields(const std::optional<T>& field) {
    add(field.has_value());
    if (field) add(*field);
  }
  template <class... T>
  void addFields(const std::variant<T...>& field) {
    add(field.index());
    std::visit([this](const auto& held) { this->add(held); }, field);
  }
  template <class T>
  void addFields(const std::vector<T>& fields) {
    add(fields.size());
    for (const T& field : fields) add(field);
  }
  void addFields(const std::string& text) {
    add(text.size());
    for (const char c : text) add(c);
  }
  void addFields(const Vec3& v) {
    for (Eigen::Index a = 0; a < 3; ++a) add(v[a]);
  }
  void addFields(const Vec2& v) {
    for (Eigen::Index a = 0; a < 2; ++a) add(v[a]);
  }

  template <class... Fields>
  void all(const Fields&... fields) {
    (add(fields), ...);
  }
  void addFields(const GravitySettings& s) { add(s.acceleration); }
  void addFields(const PressureSettings& s) { all(s.form, s.background_pressure); }
  void addFields(const NewtonianRheology&) {}
  void addFields(const CarreauYasudaRheology& s) { all(s.zero_shear, s.infinite_shear, s.time, s.power, s.transition); }
  void addFields(const CassonRheology& s) { all(s.yield_stress, s.viscosity, s.regularisation_shear_rate); }
  void addFields(const ViscositySettings& s) { all(s.viscosity, s.rheology, s.solve, s.solve_tolerance, s.max_iterations); }
  void addFields(const SurfaceTensionSettings& s) { all(s.coefficient, s.normal_cutoff, s.contact_angle); }
  void addFields(const PlateletSettings& s) {
    all(s.fresh, s.diffusivity, s.activation_rate, s.wall_rate, s.air_rate, s.shear_gate, s.clot_viscosity, s.clot_speedup);
  }
  void addFields(const CoreRadiusSettings& s) { all(s.smallest, s.largest, s.relaxation); }
  void addFields(const RepulsionSettings& s) { all(s.strength, s.contact_distance, s.power_1, s.power_2, s.damping); }
  void addFields(const AdhesionSettings& s) { add(s.acceleration); }
  void addFields(const AppliedForceSettings& s) { add(s.max_sources); }
  void addFields(const EffectSettings& s) {
    all(s.gravity, s.pressure, s.viscosity, s.surface_tension, s.platelets, s.core_radius, s.repulsion, s.adhesion,
        s.applied_force);
  }
  void addFields(const LiteralSettings& s) {
    all(s.pressure, s.stiffness, s.tension, s.normal_cutoff, s.thickening, s.thickening_exponent, s.platelet_diffusivity,
        s.repulsion, s.power_1, s.power_2, s.contact_radius);
  }
  void addFields(const Domain& d) { all(d.lower, d.upper, d.periodic[0], d.periodic[1], d.periodic[2]); }
  void addFields(const Compressibility& c) { all(c.mach_factor, c.design_speed, c.max_fall_or_depth); }
  void addFields(const PlaneShape& s) { all(s.point, s.normal); }
  void addFields(const BoxShape& s) { all(s.lower, s.upper, s.obstacle, s.open_top); }
  void addFields(const BowlShape& s) { all(s.rim_center, s.sphere_radius, s.depth); }
  void addFields(const TissueDescription& t) { all(t.name, t.shape, t.slip); }
  void addFields(const DiscPatch& s) { add(s.radius); }
  void addFields(const EllipsePatch& s) { all(s.semi_axis_u, s.semi_axis_v); }
  void addFields(const PolygonPatch& s) { add(s.points); }
  void addFields(const PolylinePatch& s) { all(s.points, s.width); }
  void addFields(const FlowDrive& d) { add(d.flow); }
  void addFields(const PressureDriveSettings& d) { all(d.inlet_pressure, d.discharge_coefficient); }
  void addFields(const WoundDescription& w) { all(w.name, w.position, w.normal, w.tangent, w.shape, w.drive); }
  void addFields(const FluidBlock& b) { all(b.lower, b.upper, b.velocity, b.jitter, b.viscosity, b.platelet); }
  void addFields(const WorldDescription& d) {
    all(d.seed, d.model, d.literal, d.planar, d.domain, d.capacity, d.spacing, d.support_ratio, d.kernel, d.rest_density,
        d.compressibility, d.effects, d.tissue, d.wounds, d.fluid_blocks, d.max_wounds, d.max_dt);
  }

  std::uint64_t hash_ = 0x243f6a8885a308d3ull;
};

}  // namespace

std::uint64_t descriptionHash(const WorldDescription& description) {
  FieldHash hash;
  hash.add(description);
  return hash.value();
}

}  // namespace bleedsim::sph
