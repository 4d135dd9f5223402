#include "service/scene/convert_effects.h"

#include <algorithm>
#include <numbers>

#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

sph::PressureSettings toPressure(const Pressure& pressure) {
  return {.form = pressure.form() == Pressure::SYMMETRIC ? sph::PressureForm::symmetric : sph::PressureForm::variational,
          .background_pressure = pressure.background_pressure_pa()};
}

sph::ViscositySolve toSolve(Viscosity::Solve solve, bool spline) {
  if (spline || solve == Viscosity::EXPLICIT) return sph::ViscositySolve::explicit_;
  return solve == Viscosity::IMPLICIT ? sph::ViscositySolve::implicit : sph::ViscositySolve::automatic;
}

/// `viscosity` of a shear-dependent blood is that of fast flow.
sph::ViscositySettings toViscosity(const Viscosity& viscosity, bool spline) {
  sph::ViscositySettings result;
  if (viscosity.has_carreau_yasuda()) {
    const CarreauYasuda& law = viscosity.carreau_yasuda();
    result.viscosity = law.infinite_shear_pa_s();
    result.rheology = sph::CarreauYasudaRheology{.zero_shear = law.zero_shear_pa_s(),
                                                 .infinite_shear = law.infinite_shear_pa_s(),
                                                 .time = law.time_s(),
                                                 .power = law.power(),
                                                 .transition = law.transition()};
  } else if (viscosity.has_casson()) {
    const Casson& law = viscosity.casson();
    result.viscosity = law.plastic_viscosity_pa_s();
    result.rheology = sph::CassonRheology{.yield_stress = law.yield_stress_pa(),
                                          .viscosity = law.plastic_viscosity_pa_s(),
                                          .regularisation_shear_rate = law.regularisation_shear_rate_per_s()};
  } else {
    result.viscosity = viscosity.viscosity_pa_s();
  }
  result.solve = toSolve(viscosity.solve(), spline);
  result.solve_tolerance = viscosity.solve_tolerance();
  result.max_iterations = static_cast<int>(viscosity.max_iterations());
  return result;
}

/// Surface tension of blood in N/m, physics.md section 2.
double tensionAt(double celsius) { return (70.105 - 0.473 * celsius) * 1e-3; }

sph::SurfaceTensionSettings toTension(const SurfaceTension& tension) {
  sph::SurfaceTensionSettings result;
  result.coefficient = tension.has_temperature_c() ? tensionAt(tension.temperature_c()) : tension.sigma_n_per_m();
  result.normal_cutoff = tension.normal_cutoff();
  if (tension.has_contact_angle_deg()) result.contact_angle = tension.contact_angle_deg() * std::numbers::pi / 180.0;
  return result;
}

sph::PlateletSettings toPlatelets(const Platelets& platelets) {
  return {.fresh = platelets.fresh(),
          .diffusivity = platelets.diffusivity_m2_per_s(),
          .activation_rate = platelets.activation_rate_per_s(),
          .wall_rate = platelets.wall_rate_per_s(),
          .air_rate = platelets.air_rate_per_s(),
          .shear_gate = platelets.shear_gate_per_s(),
          .clot_viscosity = platelets.clot_viscosity_pa_s(),
          .clot_speedup = platelets.clot_speedup()};
}

sph::RepulsionSettings toRepulsion(const Repulsion& repulsion) {
  return {.strength = repulsion.strength(),
          .contact_distance = repulsion.contact_distance(),
          .power_1 = static_cast<int>(repulsion.power_1()),
          .power_2 = static_cast<int>(repulsion.power_2()),
          .damping = repulsion.damping()};
}

}  // namespace

sph::EffectSettings convertEffects(const Effects& effects, bool spline) {
  sph::EffectSettings result;
  if (effects.has_gravity()) {
    const Vec3& g = effects.gravity().acceleration_m_per_s2();
    result.gravity = sph::GravitySettings{{g.x(), g.y(), g.z()}};
  }
  if (effects.has_pressure()) result.pressure = toPressure(effects.pressure());
  if (effects.has_viscosity()) result.viscosity = toViscosity(effects.viscosity(), spline);
  if (effects.has_applied_force()) result.applied_force = sph::AppliedForceSettings{effects.applied_force().max_sources()};
  if (effects.has_surface_tension()) result.surface_tension = toTension(effects.surface_tension());
  if (effects.has_platelets()) result.platelets = toPlatelets(effects.platelets());
  if (effects.has_core_radius()) {
    result.core_radius = sph::CoreRadiusSettings{.smallest = effects.core_radius().smallest(),
                                                 .largest = effects.core_radius().largest(),
                                                 .relaxation = effects.core_radius().relaxation()};
  }
  if (effects.has_repulsion()) result.repulsion = toRepulsion(effects.repulsion());
  if (effects.has_adhesion()) result.adhesion = sph::AdhesionSettings{effects.adhesion().acceleration_m_per_s2()};
  return result;
}

sph::LiteralSettings convertLiteral(const Literal& literal) {
  sph::LiteralSettings result;
  result.pressure = literal.pressure() == Literal::VARIATIONAL ? sph::PressureForm::variational : sph::PressureForm::symmetric;
  if (literal.has_stiffness_m2_per_s2()) result.stiffness = literal.stiffness_m2_per_s2();
  result.tension = literal.tension_n_per_m();
  result.normal_cutoff = literal.normal_cutoff();
  result.thickening = literal.thickening_pa_s();
  if (literal.has_thickening_exponent()) result.thickening_exponent = literal.thickening_exponent();
  result.platelet_diffusivity = literal.platelet_diffusivity_m2_per_s();
  if (literal.has_repulsion_n_m2()) result.repulsion = literal.repulsion_n_m2();
  result.power_1 = static_cast<int>(literal.power_1());
  result.power_2 = static_cast<int>(literal.power_2());
  result.contact_radius = literal.contact_radius();
  return result;
}

std::uint32_t convertAttributes(const Output& output) {
  std::uint32_t bits = 0;
  for (const int attribute : output.attributes()) {
    if (attribute == Output::VELOCITY) bits |= sph::kFrameVelocity;
    if (attribute == Output::DENSITY) bits |= sph::kFrameDensity;
    if (attribute == Output::VISCOSITY) bits |= sph::kFrameViscosity;
    if (attribute == Output::PLATELET) bits |= sph::kFramePlatelet;
    if (attribute == Output::RADIUS) bits |= sph::kFrameRadius;
  }
  return bits;
}

}  // namespace bleedsim::scene
