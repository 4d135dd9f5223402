// Defaults of the effects: those of service/sph/effect_settings.h.
#include <algorithm>
#include <string>
#include <vector>

#include "service/scene/fill_defaults.h"
#include "service/sph/effect_settings.h"

namespace bleedsim::scene {
namespace {

template <class M, class T>
void fill(M& message, bool (M::*has)() const, void (M::*set)(T), T value) {
  if (!(message.*has)()) (message.*set)(value);
}

void fillViscosity(Viscosity& v) {
  const sph::ViscositySettings d;
  if (v.rheology_case() == Viscosity::RHEOLOGY_NOT_SET) v.set_viscosity_pa_s(d.viscosity);
  if (v.has_carreau_yasuda()) {
    const sph::CarreauYasudaRheology c;
    CarreauYasuda& m = *v.mutable_carreau_yasuda();
    fill(m, &CarreauYasuda::has_zero_shear_pa_s, &CarreauYasuda::set_zero_shear_pa_s, c.zero_shear);
    fill(m, &CarreauYasuda::has_infinite_shear_pa_s, &CarreauYasuda::set_infinite_shear_pa_s, c.infinite_shear);
    fill(m, &CarreauYasuda::has_time_s, &CarreauYasuda::set_time_s, c.time);
    fill(m, &CarreauYasuda::has_power, &CarreauYasuda::set_power, c.power);
    fill(m, &CarreauYasuda::has_transition, &CarreauYasuda::set_transition, c.transition);
  }
  if (v.has_casson()) {
    const sph::CassonRheology c;
    Casson& m = *v.mutable_casson();
    fill(m, &Casson::has_yield_stress_pa, &Casson::set_yield_stress_pa, c.yield_stress);
    fill(m, &Casson::has_plastic_viscosity_pa_s, &Casson::set_plastic_viscosity_pa_s, c.viscosity);
    fill(m, &Casson::has_regularisation_shear_rate_per_s, &Casson::set_regularisation_shear_rate_per_s,
         c.regularisation_shear_rate);
  }
  fill(v, &Viscosity::has_solve, &Viscosity::set_solve, Viscosity::AUTOMATIC);
  fill(v, &Viscosity::has_solve_tolerance, &Viscosity::set_solve_tolerance, d.solve_tolerance);
  fill(v, &Viscosity::has_max_iterations, &Viscosity::set_max_iterations, static_cast<std::uint32_t>(d.max_iterations));
}

void fillTension(SurfaceTension& t) {
  const sph::SurfaceTensionSettings d;
  if (t.coefficient_case() == SurfaceTension::COEFFICIENT_NOT_SET) t.set_sigma_n_per_m(d.coefficient);
  fill(t, &SurfaceTension::has_normal_cutoff, &SurfaceTension::set_normal_cutoff, d.normal_cutoff);
}

void fillPlatelets(Platelets& p) {
  const sph::PlateletSettings d;
  fill(p, &Platelets::has_fresh, &Platelets::set_fresh, d.fresh);
  fill(p, &Platelets::has_diffusivity_m2_per_s, &Platelets::set_diffusivity_m2_per_s, d.diffusivity);
  fill(p, &Platelets::has_activation_rate_per_s, &Platelets::set_activation_rate_per_s, d.activation_rate);
  fill(p, &Platelets::has_wall_rate_per_s, &Platelets::set_wall_rate_per_s, d.wall_rate);
  fill(p, &Platelets::has_air_rate_per_s, &Platelets::set_air_rate_per_s, d.air_rate);
  fill(p, &Platelets::has_shear_gate_per_s, &Platelets::set_shear_gate_per_s, d.shear_gate);
  fill(p, &Platelets::has_clot_viscosity_pa_s, &Platelets::set_clot_viscosity_pa_s, d.clot_viscosity);
  fill(p, &Platelets::has_clot_speedup, &Platelets::set_clot_speedup, d.clot_speedup);
}

void fillCoreRadius(CoreRadius& r) {
  const sph::CoreRadiusSettings d;
  fill(r, &CoreRadius::has_smallest, &CoreRadius::set_smallest, d.smallest);
  fill(r, &CoreRadius::has_largest, &CoreRadius::set_largest, d.largest);
  fill(r, &CoreRadius::has_relaxation, &CoreRadius::set_relaxation, d.relaxation);
}

void fillRepulsion(Repulsion& r) {
  const sph::RepulsionSettings d;
  fill(r, &Repulsion::has_strength, &Repulsion::set_strength, d.strength);
  fill(r, &Repulsion::has_contact_distance, &Repulsion::set_contact_distance, d.contact_distance);
  fill(r, &Repulsion::has_power_1, &Repulsion::set_power_1, static_cast<std::uint32_t>(d.power_1));
  fill(r, &Repulsion::has_power_2, &Repulsion::set_power_2, static_cast<std::uint32_t>(d.power_2));
  fill(r, &Repulsion::has_damping, &Repulsion::set_damping, d.damping);
}

/// Each name once, in alphabetical order.
void sortAuto(Effects& effects) {
  std::vector<std::string> names{effects.auto_().begin(), effects.auto_().end()};
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  effects.mutable_auto_()->Assign(names.begin(), names.end());
}

}  // namespace

void fillEffects(Effects& effects) {
  if (effects.has_gravity() && !effects.gravity().has_acceleration_m_per_s2()) {
    const sph::Vec3 g = sph::GravitySettings{}.acceleration;
    Vec3& acceleration = *effects.mutable_gravity()->mutable_acceleration_m_per_s2();
    acceleration.set_x(g.x());
    acceleration.set_y(g.y());
    acceleration.set_z(g.z());
  }
  if (effects.has_pressure()) fill(*effects.mutable_pressure(), &Pressure::has_form, &Pressure::set_form, Pressure::VARIATIONAL);
  if (effects.has_viscosity()) fillViscosity(*effects.mutable_viscosity());
  if (effects.has_applied_force()) {
    fill(*effects.mutable_applied_force(), &AppliedForce::has_max_sources, &AppliedForce::set_max_sources,
         sph::AppliedForceSettings{}.max_sources);
  }
  if (effects.has_surface_tension()) fillTension(*effects.mutable_surface_tension());
  if (effects.has_platelets()) fillPlatelets(*effects.mutable_platelets());
  if (effects.has_core_radius()) fillCoreRadius(*effects.mutable_core_radius());
  if (effects.has_repulsion()) fillRepulsion(*effects.mutable_repulsion());
  if (effects.has_adhesion()) {
    fill(*effects.mutable_adhesion(), &Adhesion::has_acceleration_m_per_s2, &Adhesion::set_acceleration_m_per_s2,
         sph::AdhesionSettings{}.acceleration);
  }
  sortAuto(effects);
}

}  // namespace bleedsim::scene
