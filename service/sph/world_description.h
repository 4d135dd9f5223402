// What a world is made from: immutable after creation, in SI units. `service/scene` fills it from a validated scene.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "service/sph/effect_settings.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {

using Vec2 = Eigen::Vector2d;

/// The box that particles may be in, m. Leaving it through a side that is not periodic removes a particle.
struct Domain {
  Vec3 lower = Vec3::Constant(-0.05);
  Vec3 upper = Vec3::Constant(0.05);
  std::array<bool, 3> periodic{false, false, false};  ///< a periodic side must measure at least three support radii
};

/// c0 = mach_factor * max(design_speed, sqrt(2 g H), sqrt(2 p_in/rho)), physics.md section 2.
struct Compressibility {
  double mach_factor = 10.0;
  double design_speed = 0.3;       ///< m/s
  double max_fall_or_depth = 0.0;  ///< H, m
};

struct PlaneShape {
  Vec3 point = Vec3::Zero();
  Vec3 normal{0.0, 0.0, 1.0};  ///< unit, into the blood
};
/// Blood inside six (or five) walls, or around a block.
struct BoxShape {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
  bool obstacle = false;  ///< true: blood is outside
  bool open_top = false;  ///< container without its upper z face
};
/// A plane facing +z at the rim, with a spherical hollow pressed into it.
struct BowlShape {
  Vec3 rim_center = Vec3::Zero();
  double sphere_radius = 0.0;  ///< m
  double depth = 0.0;          ///< m, of the lowest point below the rim, <= sphere_radius
};
struct TissueDescription {
  std::string name;
  std::variant<PlaneShape, BoxShape, BowlShape> shape;
  double slip = 0.0;  ///< 0: no slip, 1: free slip
};

struct DiscPatch {
  double radius = 0.0;
};  ///< m
struct EllipsePatch {
  double semi_axis_u = 0.0, semi_axis_v = 0.0;
};  ///< m
struct PolygonPatch {
  std::vector<Vec2> points;
};  ///< closed, m
struct PolylinePatch {
  std::vector<Vec2> points;
  double width = 0.0;
};  ///< open, m
using PatchShape = std::variant<DiscPatch, EllipsePatch, PolygonPatch, PolylinePatch>;

struct FlowDrive {
  double flow = 0.0;
};  ///< m^3/s
/// Orifice law: v = Cd sqrt(2 dp/rho), flow = v x patch area.
struct PressureDriveSettings {
  double inlet_pressure = 0.0;
  double discharge_coefficient = 0.61;
};  ///< Pa, 1
using WoundDrive = std::variant<FlowDrive, PressureDriveSettings>;

struct WoundDescription {
  std::string name;
  Vec3 position = Vec3::Zero();
  Vec3 normal{0.0, 0.0, 1.0};   ///< unit, out of the tissue
  Vec3 tangent = Vec3::Zero();  ///< u axis; zero: chosen
  PatchShape shape = DiscPatch{};
  WoundDrive drive = FlowDrive{};
};

/// Particles present at the start: a cubic lattice whose first rows stand half a spacing inside the faces.
struct FluidBlock {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  double jitter = 0.0;              ///< uniform, of each coordinate, in spacings
  std::optional<double> viscosity;  ///< Pa s, whatever the shear rate
  std::optional<double> platelet;   ///< P, 0 to 1; without it PlateletSettings::fresh
};

struct WorldDescription {
  std::uint64_t seed = 1;
  Domain domain;
  std::uint32_t capacity = 0;  ///< most particles at any time
  double spacing = 0.001;      ///< dx, m
  double support_ratio = 2.0;  ///< h/dx
  KernelType kernel = KernelType::wendland_c2;
  double rest_density = 1060.0;  ///< kg/m^3
  Compressibility compressibility;
  EffectSettings effects;
  std::vector<TissueDescription> tissue;
  std::vector<WoundDescription> wounds;
  std::vector<FluidBlock> fluid_blocks;
  std::uint32_t max_wounds = 64;
  double max_dt = std::numeric_limits<double>::infinity();  ///< s

  double supportRadius() const { return support_ratio * spacing; }
  double particleVolume() const { return spacing * spacing * spacing; }
};

/// The numerical speed of sound of a description, m/s: physics.md section 2, the scene's wounds included.
double speedOfSound(const WorldDescription& description);

}  // namespace bleedsim::sph
