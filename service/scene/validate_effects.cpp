#include <cmath>
#include <fmt/format.h>
#include <string>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

void validateViscosity(const Viscosity& viscosity, ProblemList& problems) {
  const std::string path = "effects.viscosity";
  switch (viscosity.rheology_case()) {
    case Viscosity::kViscosityPaS:
      problems.requireInRange(path + ".viscosity_pa_s", viscosity.viscosity_pa_s(), kViscosity);
      break;
    case Viscosity::kCarreauYasuda: {
      const CarreauYasuda& law = viscosity.carreau_yasuda();
      problems.requireInRange(path + ".carreau_yasuda.zero_shear_pa_s", law.zero_shear_pa_s(), kShearViscosity);
      problems.requireInRange(path + ".carreau_yasuda.infinite_shear_pa_s", law.infinite_shear_pa_s(), kShearViscosity);
      problems.requireInRange(path + ".carreau_yasuda.time_s", law.time_s(), kRheologyTime);
      problems.requireInRange(path + ".carreau_yasuda.power", law.power(), kRheologyPower);
      problems.requireInRange(path + ".carreau_yasuda.transition", law.transition(), kRheologyTransition);
      if (law.infinite_shear_pa_s() > law.zero_shear_pa_s()) {
        problems.add(path + ".carreau_yasuda.infinite_shear_pa_s",
                     fmt::format("value {} is above zero_shear_pa_s, {}: blood thins by shear", law.infinite_shear_pa_s(),
                                 law.zero_shear_pa_s()));
      }
      break;
    }
    case Viscosity::kCasson: {
      const Casson& law = viscosity.casson();
      problems.requireInRange(path + ".casson.yield_stress_pa", law.yield_stress_pa(), kYieldStress);
      problems.requireInRange(path + ".casson.plastic_viscosity_pa_s", law.plastic_viscosity_pa_s(), kShearViscosity);
      problems.requireInRange(path + ".casson.regularisation_shear_rate_per_s", law.regularisation_shear_rate_per_s(),
                              kRegularisation);
      break;
    }
    case Viscosity::RHEOLOGY_NOT_SET:
      break;
  }
  if (!Viscosity::Solve_IsValid(viscosity.solve())) {
    problems.add(path + ".solve", fmt::format("value {} is unknown, known are AUTOMATIC, EXPLICIT, IMPLICIT",
                                              static_cast<int>(viscosity.solve())));
  }
  problems.requireInRange(path + ".solve_tolerance", viscosity.solve_tolerance(), kSolveTolerance);
  problems.requireInRange(path + ".max_iterations", viscosity.max_iterations(), kSolveIterations);
}

void validateTension(const SurfaceTension& tension, ProblemList& problems) {
  const std::string path = "effects.surface_tension";
  if (tension.has_temperature_c()) {
    problems.requireInRange(path + ".temperature_c", tension.temperature_c(), kTemperature);
  } else {
    problems.requireInRange(path + ".sigma_n_per_m", tension.sigma_n_per_m(), kSurfaceTension);
  }
  problems.requireInRange(path + ".normal_cutoff", tension.normal_cutoff(), kNormalCutoff);
  if (tension.has_contact_angle_deg()) {
    problems.requireInRange(path + ".contact_angle_deg", tension.contact_angle_deg(), kContactAngle);
  }
}

void validatePlatelets(const Platelets& platelets, ProblemList& problems) {
  const std::string path = "effects.platelets";
  problems.requireInRange(path + ".fresh", platelets.fresh(), kPlatelet);
  problems.requireInRange(path + ".diffusivity_m2_per_s", platelets.diffusivity_m2_per_s(), kDiffusivity);
  problems.requireInRange(path + ".activation_rate_per_s", platelets.activation_rate_per_s(), kClotRate);
  problems.requireInRange(path + ".wall_rate_per_s", platelets.wall_rate_per_s(), kClotRate);
  problems.requireInRange(path + ".air_rate_per_s", platelets.air_rate_per_s(), kClotRate);
  problems.requireInRange(path + ".shear_gate_per_s", platelets.shear_gate_per_s(), kShearGate);
  problems.requireInRange(path + ".clot_viscosity_pa_s", platelets.clot_viscosity_pa_s(), kShearViscosity);
  problems.requireInRange(path + ".clot_speedup", platelets.clot_speedup(), kClotSpeedup);
}

void validateRepulsion(const Repulsion& repulsion, ProblemList& problems) {
  const std::string path = "effects.repulsion";
  problems.requireInRange(path + ".strength", repulsion.strength(), kRepulsionStrength);
  problems.requireInRange(path + ".contact_distance", repulsion.contact_distance(), kContactDistance);
  problems.requireInRange(path + ".power_1", repulsion.power_1(), kRepulsionPower);
  problems.requireInRange(path + ".power_2", repulsion.power_2(), kRepulsionPower);
  problems.requireInRange(path + ".damping", repulsion.damping(), kRepulsionDamping);
  if (repulsion.power_1() <= repulsion.power_2()) {
    problems.add(path + ".power_1", fmt::format("value {} must be above power_2, {}, or contact would attract",
                                                repulsion.power_1(), repulsion.power_2()));
  }
}

}  // namespace

void validateEffects(const Scene& scene, ProblemList& problems) {
  const Effects& effects = scene.effects();
  if (effects.has_gravity()) {
    const Vec3& g = effects.gravity().acceleration_m_per_s2();
    problems.requireInRange("effects.gravity.acceleration_m_per_s2", std::hypot(g.x(), g.y(), g.z()), kGravity);
  }
  if (effects.has_pressure()) {
    problems.requireInRange("effects.pressure.background_pressure_pa", effects.pressure().background_pressure_pa(),
                            kBackgroundPressure);
    if (!Pressure::Form_IsValid(effects.pressure().form())) {
      problems.add("effects.pressure.form", fmt::format("value {} is unknown, known are VARIATIONAL, SYMMETRIC",
                                                        static_cast<int>(effects.pressure().form())));
    }
  }
  if (effects.has_viscosity()) validateViscosity(effects.viscosity(), problems);
  if (effects.has_applied_force()) {
    problems.requireInRange("effects.applied_force.max_sources", effects.applied_force().max_sources(), kMaxSources);
  }
  if (effects.has_surface_tension()) validateTension(effects.surface_tension(), problems);
  if (effects.has_platelets()) validatePlatelets(effects.platelets(), problems);
  if (effects.has_core_radius()) {
    problems.requireInRange("effects.core_radius.smallest", effects.core_radius().smallest(), kSmallestRadius);
    problems.requireInRange("effects.core_radius.largest", effects.core_radius().largest(), kLargestRadius);
    problems.requireInRange("effects.core_radius.relaxation", effects.core_radius().relaxation(), kRadiusRelaxation);
  }
  if (effects.has_repulsion()) validateRepulsion(effects.repulsion(), problems);
  if (effects.has_adhesion()) {
    problems.requireInRange("effects.adhesion.acceleration_m_per_s2", effects.adhesion().acceleration_m_per_s2(), kAdhesion);
  }
}

}  // namespace bleedsim::scene
