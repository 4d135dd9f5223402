// Every effect that this build knows. A new one adds a header, a row here, an optional message in scene.proto and a mapping line.
#pragma once

#include <array>

#include "service/sph/world.h"

namespace bleedsim::sph {

struct EffectRow {
  EffectInfo info;
  bool (*enabled)(const EffectSettings& settings);
};

inline constexpr std::array<EffectRow, 5> kEffects{{
    {{"gravity", "F of (9)", "the paper", "none"}, [](const EffectSettings& s) { return s.gravity.has_value(); }},
    {{"pressure", "(16)(19)(20)", "Monaghan 1992; Wendland 1995",
      "variational (16) instead of (17), Wendland C2 for density and gradient, p >= 0"},
     [](const EffectSettings& s) { return s.pressure.has_value(); }},
    {{"viscosity", "(25)", "Brookshaw 1985; Morris 1997; Cleary & Monaghan 1999; Cho & Kensey 1991; Casson 1959",
      "Brookshaw form with harmonic mean, calibrated on the rest lattice, instead of the Laplacian of (33); Newtonian, "
      "Carreau-Yasuda or Casson"},
     [](const EffectSettings& s) { return s.viscosity.has_value(); }},
    {{"platelets", "(26)(27)", "Brookshaw 1985; bleedsim",
      "reciprocal diffusion instead of (33); sinks by activation, tissue and air, without which nothing clots; a of (26) from "
      "the "
      "fresh viscosity"},
     [](const EffectSettings& s) { return s.platelets.has_value(); }},
    {{"applied_force", "-", "bleedsim", "not in the paper: force of instruments and commands on the fluid"},
     [](const EffectSettings& s) { return s.applied_force.has_value(); }},
}};

}  // namespace bleedsim::sph
