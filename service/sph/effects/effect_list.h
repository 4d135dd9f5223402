// Every effect that this build knows. A new one adds a header, a row here, an optional message in scene.proto and a mapping line.
#pragma once

#include <algorithm>
#include <array>

#include "service/sph/world.h"

namespace bleedsim::sph {

/// How to reach an effect's settings among all.
struct EffectSlot {
  bool (*present)(const EffectSettings& settings);
  void (*remove)(EffectSettings& settings);
  /// Takes the effect from `source`, or with its defaults if that lacks it.
  void (*add)(EffectSettings& settings, const EffectSettings& source);
};

template <auto kMember>
constexpr EffectSlot effectSlot() {
  return {[](const EffectSettings& settings) { return (settings.*kMember).has_value(); },
          [](EffectSettings& settings) { (settings.*kMember).reset(); },
          [](EffectSettings& settings, const EffectSettings& source) {
            if (source.*kMember)
              settings.*kMember = source.*kMember;
            else
              (settings.*kMember).emplace();
          }};
}

struct EffectRow {
  EffectInfo info;
  EffectSlot slot;
};

inline constexpr std::array<EffectRow, 9> kEffects{{
    {{"gravity", "F of (9)", "the paper; service/sph/integrate/closing_kick.h", "none"}, effectSlot<&EffectSettings::gravity>()},
    {{"pressure", "(16)(17)(18)(19)(20)", "Monaghan 1992; Wendland 1995; service/sph/effects/pressure-inl.h",
      "p = c0^2 (rho - rho0) of (19), never negative, instead of p = k rho of (18); (16) by default, (17) on request; Wendland "
      "C2, "
      "or a cubic spline, for density and gradient instead of poly6 and spiky; the mass of a particle is calibrated, so that the "
      "rest lattice has rho0"},
     effectSlot<&EffectSettings::pressure>()},
    {{"viscosity", "(25)",
      "Brookshaw 1985; Morris 1997; Cleary & Monaghan 1999; Cho & Kensey 1991; Casson 1959; service/sph/effects/viscosity-inl.h",
      "Brookshaw form with harmonic mean, calibrated on the rest lattice, instead of the Laplacian of (33); Newtonian, "
      "Carreau-Yasuda or Casson; implicit where the explicit limit would bind"},
     effectSlot<&EffectSettings::viscosity>()},
    {{"platelets", "(26)(27)", "Brookshaw 1985; bleedsim; service/sph/effects/platelets-inl.h",
      "reciprocal diffusion instead of (33); sinks by activation, tissue and air, without which nothing clots; a of (26) from "
      "the fresh viscosity"},
     effectSlot<&EffectSettings::platelets>()},
    {{"core_radius", "(34)", "the paper; Hernquist & Katz 1989; service/sph/effects/core_radius.h",
      "bounded, relaxed over steps, blind to 15 % of density, kernels averaged over a pair, calibrated on the rest lattice at "
      "each radius"},
     effectSlot<&EffectSettings::core_radius>()},
    {{"repulsion", "(35)(36)", "the paper; service/sph/effects/repulsion-inl.h",
      "added to the other forces, D scaled by m c0^2 dx, a pair's push bounded, pairs in contact damped, its own limit of the "
      "time step"},
     effectSlot<&EffectSettings::repulsion>()},
    {{"surface_tension", "(21)-(23)", "Brackbill 1992; Morris 2000; Breinlinger 2013; service/sph/effects/surface_tension.h",
      "curvature of kept normals instead of the Laplacian of the colour field, |kappa| h <= 2; a factor of 1.56 fitted to drops "
      "at "
      "rest; a ramp from the cut-off of |n| to twice it instead of the cut; an artificial viscosity nu = 0.2 h sqrt(sigma/(rho0 "
      "h)) "
      "between surface particles, without which drops boil; no net force on a free body"},
     effectSlot<&EffectSettings::surface_tension>()},
    {{"adhesion", "-", "bleedsim; service/sph/effects/adhesion.h", "not in the paper as a formula: a pull to tissue within h"},
     effectSlot<&EffectSettings::adhesion>()},
    {{"applied_force", "-", "bleedsim; service/sph/effects/applied_force.h",
      "not in the paper: force of instruments and commands on the fluid"},
     effectSlot<&EffectSettings::applied_force>()},
}};

/// What acts by a setting of something else, not by a message of its own among the effects.
struct PartRow {
  EffectInfo info;
  bool (*acts)(const WorldDescription& description);
};

inline constexpr std::array<PartRow, 2> kEffectParts{{
    {{"wetting", "-", "Breinlinger 2013; service/sph/effects/surface_tension.h",
      "not in the paper: surface_tension.contact_angle_deg turns the normals within h of tissue"},
     [](const WorldDescription& description) {
       const auto& tension = description.effects.surface_tension;
       return tension && tension->contact_angle;
     }},
    {{"slip", "-", "bleedsim; service/sph/tissue/wall_combination.h",
      "not in the paper: tissue.slip takes its part off the viscous grip of tissue, 0 sticks and 1 slides",
      "not in the paper, as in the sound model"},
     [](const WorldDescription& description) {
       return std::any_of(description.tissue.begin(), description.tissue.end(),
                          [](const TissueDescription& tissue) { return tissue.slip > 0.0; });
     }},
}};

}  // namespace bleedsim::sph
