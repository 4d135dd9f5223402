#include "service/lab/torture/random_effects.h"

namespace bleedsim::lab {
namespace {

using scene::Effects;
using scene::Scene;

void addGravity(Dice& dice, Effects& effects) {
  scene::Gravity& gravity = *effects.mutable_gravity();
  if (dice.chance(0.6)) return;
  const double strength = dice.overMagnitudes(0.01, 100.0);
  const sph::Vec3 g = strength * dice.within(sph::Vec3::Constant(-1.0), sph::Vec3::Constant(1.0));
  gravity.mutable_acceleration_m_per_s2()->set_x(g.x());
  gravity.mutable_acceleration_m_per_s2()->set_y(g.y());
  gravity.mutable_acceleration_m_per_s2()->set_z(g.z());
}

/// `thickest` fresh blood that platelets may thicken, Pa s.
void addViscosity(Dice& dice, bool literal, double thickest, Effects& effects) {
  scene::Viscosity& viscosity = *effects.mutable_viscosity();
  const int law = literal ? dice.upTo(1) : dice.upTo(3);
  if (law == 1) viscosity.set_viscosity_pa_s(dice.overMagnitudes(1e-4, thickest));
  if (law == 2) viscosity.mutable_carreau_yasuda()->set_time_s(dice.overMagnitudes(1e-3, 100.0));
  if (law == 3) viscosity.mutable_casson()->set_yield_stress_pa(dice.overMagnitudes(1e-3, 10.0));
  if (literal) return;
  if (dice.chance(0.25)) viscosity.set_solve(dice.chance(0.5) ? scene::Viscosity::IMPLICIT : scene::Viscosity::EXPLICIT);
  if (dice.chance(0.2)) viscosity.set_max_iterations(static_cast<std::uint32_t>(1 + dice.upTo(30)));
  if (dice.chance(0.2)) viscosity.set_solve_tolerance(dice.overMagnitudes(1e-6, 0.4));
}

void addTension(Dice& dice, bool literal, bool tissue, Effects& effects) {
  scene::SurfaceTension& tension = *effects.mutable_surface_tension();
  if (literal) return;
  if (dice.chance(0.4)) tension.set_sigma_n_per_m(dice.overMagnitudes(1e-3, 0.8));
  if (dice.chance(0.3)) tension.set_normal_cutoff(dice.overMagnitudes(0.02, 2.0));
  if (tissue && dice.chance(0.5)) tension.set_contact_angle_deg(dice.between(0.0, 180.0));
}

void addPlatelets(Dice& dice, bool literal, Effects& effects) {
  scene::Platelets& platelets = *effects.mutable_platelets();
  if (dice.chance(0.3)) platelets.set_fresh(dice.part());
  if (literal) return;
  if (dice.chance(0.5)) platelets.set_clot_speedup(dice.overMagnitudes(0.1, 1e4));
  if (dice.chance(0.3)) platelets.set_diffusivity_m2_per_s(dice.overMagnitudes(1e-12, 1e-4));
  if (dice.chance(0.3)) platelets.set_clot_viscosity_pa_s(dice.overMagnitudes(1.0, 900.0));
}

void addRepulsion(Dice& dice, bool literal, Effects& effects) {
  scene::Repulsion& repulsion = *effects.mutable_repulsion();
  if (literal) return;
  if (dice.chance(0.4)) repulsion.set_strength(dice.between(0.0, 10.0));
  if (dice.chance(0.4)) repulsion.set_contact_distance(dice.between(0.1, 1.0));
  if (dice.chance(0.3)) repulsion.set_damping(dice.between(0.0, 10.0));
  if (dice.chance(0.2)) repulsion.set_power_1(static_cast<std::uint32_t>(5 + dice.upTo(7)));
}

void addCoreRadius(Dice& dice, bool literal, Effects& effects) {
  scene::CoreRadius& radius = *effects.mutable_core_radius();
  if (literal || dice.chance(0.5)) return;
  radius.set_smallest(dice.between(0.5, 1.0));
  radius.set_largest(dice.between(1.0, 1.5));
  radius.set_relaxation(dice.overMagnitudes(1e-3, 1.0));
}

}  // namespace

void addRandomEffects(Dice& dice, bool literal, Scene& scene) {
  Effects& effects = *scene.mutable_effects();
  const bool tissue = scene.tissue_size() > 0;
  if (dice.chance(0.8)) addGravity(dice, effects);
  if (dice.chance(0.9)) {
    effects.mutable_pressure();
    if (!literal && dice.chance(0.15)) effects.mutable_pressure()->set_form(scene::Pressure::SYMMETRIC);
    if (!literal && dice.chance(0.1)) effects.mutable_pressure()->set_background_pressure_pa(dice.overMagnitudes(1.0, 1e4));
  }
  const bool platelets = dice.chance(0.35);
  if (platelets || dice.chance(0.8)) addViscosity(dice, literal, platelets ? 0.5 : 200.0, effects);
  if (platelets) addPlatelets(dice, literal, effects);
  if (dice.chance(0.4)) addTension(dice, literal, tissue, effects);
  if (dice.chance(0.35)) addCoreRadius(dice, literal, effects);
  if (dice.chance(0.35)) addRepulsion(dice, literal, effects);
  if (dice.chance(0.7)) effects.mutable_applied_force();
  if (tissue && !literal && dice.chance(0.3)) {
    effects.mutable_adhesion()->set_acceleration_m_per_s2(dice.overMagnitudes(0.1, 900.0));
  }
  for (scene::FluidBlock& block : *scene.mutable_fluid_blocks()) {
    if (effects.has_viscosity() && dice.chance(0.25))
      block.set_viscosity_pa_s(dice.overMagnitudes(1e-4, platelets ? 0.5 : 200.0));
    if (platelets && dice.chance(0.4)) block.set_platelet(dice.part());
  }
}

}  // namespace bleedsim::lab
