// Every effect that this build knows. A new one adds a header, a row here, an optional message in scene.proto and a mapping line.
#pragma once

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
    {{"gravity", "F of (9)", "the paper", "none"}, effectSlot<&EffectSettings::gravity>()},
    {{"pressure", "(16)(17)(19)(20)", "Monaghan 1992; Wendland 1995",
      "(16) by default, (17) on request; Wendland C2, or a cubic spline, for density and gradient instead of poly6 and spiky; p "
      ">= 0"},
     effectSlot<&EffectSettings::pressure>()},
    {{"viscosity", "(25)", "Brookshaw 1985; Morris 1997; Cleary & Monaghan 1999; Cho & Kensey 1991; Casson 1959",
      "Brookshaw form with harmonic mean, calibrated on the rest lattice, instead of the Laplacian of (33); Newtonian, "
      "Carreau-Yasuda or Casson"},
     effectSlot<&EffectSettings::viscosity>()},
    {{"platelets", "(26)(27)", "Brookshaw 1985; bleedsim",
      "reciprocal diffusion instead of (33); sinks by activation, tissue and air, without which nothing clots; a of (26) from "
      "the "
      "fresh viscosity"},
     effectSlot<&EffectSettings::platelets>()},
    {{"core_radius", "(34)", "the paper; Hernquist & Katz 1989",
      "bounded, relaxed over steps, blind to 15 % of density, kernels averaged over a pair, calibrated on the rest lattice at "
      "each radius"},
     effectSlot<&EffectSettings::core_radius>()},
    {{"repulsion", "(35)(36)", "the paper",
      "added to the other forces, D scaled by m c0^2 dx, a pair's push bounded, pairs in contact damped, its own limit of the "
      "time step"},
     effectSlot<&EffectSettings::repulsion>()},
    {{"surface_tension", "(21)-(23)", "Brackbill 1992; Morris 2000; Breinlinger 2013",
      "curvature of kept normals instead of the Laplacian of the colour field; contact angle; no net force on a free body"},
     effectSlot<&EffectSettings::surface_tension>()},
    {{"adhesion", "-", "bleedsim", "not in the paper as a formula: a pull to tissue within h"},
     effectSlot<&EffectSettings::adhesion>()},
    {{"applied_force", "-", "bleedsim", "not in the paper: force of instruments and commands on the fluid"},
     effectSlot<&EffectSettings::applied_force>()},
}};

}  // namespace bleedsim::sph
