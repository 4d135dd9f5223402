#include "service/lab/torture/random_effects.h"

#include <array>
#include <string>
#include <string_view>

#include "service/scene/read_text.h"

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

void addPressure(Dice& dice, bool literal, Effects& effects) {
  scene::Pressure& pressure = *effects.mutable_pressure();
  if (!literal && dice.chance(0.15)) pressure.set_form(scene::Pressure::SYMMETRIC);
  if (!literal && dice.chance(0.1)) pressure.set_background_pressure_pa(dice.overMagnitudes(1.0, 1e4));
}

/// Of fresh blood that platelets may thicken, or that they are not in, Pa s.
constexpr double thickestBlood(bool platelets) { return platelets ? 0.5 : 200.0; }

/// `thickest` fresh blood that the law may give, Pa s.
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

void addAdhesion(Dice& dice, Effects& effects) {
  effects.mutable_adhesion()->set_acceleration_m_per_s2(dice.overMagnitudes(0.1, 900.0));
}

/// An effect by its name.
struct Slot {
  std::string_view name;
  bool (Effects::*is_on)() const;
  void (Effects::*clear)();
  std::string (*settings)(const Effects&);  ///< as text
};
/// All of them, in the order of idl/scene.proto.
constexpr std::array kSlots{
    Slot{"gravity", &Effects::has_gravity, &Effects::clear_gravity,
         [](const Effects& e) { return scene::writeText(e.gravity()); }},
    Slot{"pressure", &Effects::has_pressure, &Effects::clear_pressure,
         [](const Effects& e) { return scene::writeText(e.pressure()); }},
    Slot{"viscosity", &Effects::has_viscosity, &Effects::clear_viscosity,
         [](const Effects& e) { return scene::writeText(e.viscosity()); }},
    Slot{"applied_force", &Effects::has_applied_force, &Effects::clear_applied_force,
         [](const Effects& e) { return scene::writeText(e.applied_force()); }},
    Slot{"surface_tension", &Effects::has_surface_tension, &Effects::clear_surface_tension,
         [](const Effects& e) { return scene::writeText(e.surface_tension()); }},
    Slot{"platelets", &Effects::has_platelets, &Effects::clear_platelets,
         [](const Effects& e) { return scene::writeText(e.platelets()); }},
    Slot{"core_radius", &Effects::has_core_radius, &Effects::clear_core_radius,
         [](const Effects& e) { return scene::writeText(e.core_radius()); }},
    Slot{"repulsion", &Effects::has_repulsion, &Effects::clear_repulsion,
         [](const Effects& e) { return scene::writeText(e.repulsion()); }},
    Slot{"adhesion", &Effects::has_adhesion, &Effects::clear_adhesion,
         [](const Effects& e) { return scene::writeText(e.adhesion()); }},
};

/// With settings from the whole of their ranges.
void addEffect(Dice& dice, std::string_view name, const Scene& scene, Effects& effects) {
  const bool literal = scene.model() == Scene::LITERAL;
  if (name == "gravity") addGravity(dice, effects);
  if (name == "pressure") addPressure(dice, literal, effects);
  if (name == "viscosity") addViscosity(dice, literal, thickestBlood(effects.has_platelets()), effects);
  if (name == "applied_force") effects.mutable_applied_force();
  if (name == "surface_tension") addTension(dice, literal, scene.tissue_size() > 0, effects);
  if (name == "platelets") addPlatelets(dice, literal, effects);
  if (name == "core_radius") addCoreRadius(dice, literal, effects);
  if (name == "repulsion") addRepulsion(dice, literal, effects);
  if (name == "adhesion") addAdhesion(dice, effects);
}

}  // namespace

void addRandomEffects(Dice& dice, bool literal, Scene& scene) {
  Effects& effects = *scene.mutable_effects();
  const bool tissue = scene.tissue_size() > 0;
  if (dice.chance(0.8)) addGravity(dice, effects);
  if (dice.chance(0.9)) addPressure(dice, literal, effects);
  const bool platelets = dice.chance(0.35);
  if (platelets || dice.chance(0.8)) addViscosity(dice, literal, thickestBlood(platelets), effects);
  if (platelets) addPlatelets(dice, literal, effects);
  if (dice.chance(0.4)) addTension(dice, literal, tissue, effects);
  if (dice.chance(0.35)) addCoreRadius(dice, literal, effects);
  if (dice.chance(0.35)) addRepulsion(dice, literal, effects);
  if (dice.chance(0.7)) effects.mutable_applied_force();
  if (tissue && !literal && dice.chance(0.3)) addAdhesion(dice, effects);
  for (scene::FluidBlock& block : *scene.mutable_fluid_blocks()) {
    if (effects.has_viscosity() && dice.chance(0.25))
      block.set_viscosity_pa_s(dice.overMagnitudes(1e-4, thickestBlood(platelets)));
    if (platelets && dice.chance(0.4)) block.set_platelet(dice.part());
  }
}

scene::EffectChange randomChange(Dice& dice, const Scene& scene, Effects& effects) {
  const Slot& slot = kSlots[static_cast<std::size_t>(dice.upTo(static_cast<int>(kSlots.size()) - 1))];
  const bool is_on = (effects.*slot.is_on)();
  scene::EffectChange change{std::string{slot.name}, dice.chance(0.85) != is_on, {}};
  (effects.*slot.clear)();
  if (!change.enabled) return change;
  addEffect(dice, slot.name, scene, effects);
  if (dice.chance(0.5)) change.settings = slot.settings(effects);
  return change;
}

}  // namespace bleedsim::lab
