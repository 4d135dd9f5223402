// Every effect that this build knows. A new one adds a header, a row here, an optional message in scene.proto and a mapping line.
#pragma once

#include <array>

#include "service/sph/world.h"

namespace bleedsim::sph {

struct EffectRow {
  EffectInfo info;
  bool (*enabled)(const EffectSettings& settings);
};

inline constexpr std::array<EffectRow, 9> kEffects{{
    {{"gravity", "F of (9)", "the paper", "none"}, [](const EffectSettings& s) { return s.gravity.has_value(); }},
    {{"pressure", "(16)(17)(19)(20)", "Monaghan 1992; Wendland 1995",
      "(16) by default, (17) on request; Wendland C2, or a cubic spline, for density and gradient instead of poly6 and spiky; p "
      ">= 0"},
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
    {{"core_radius", "(34)", "the paper; Hernquist & Katz 1989",
      "bounded, relaxed over steps, blind to 15 % of density, kernels averaged over a pair, calibrated on the rest lattice at "
      "each radius"},
     [](const EffectSettings& s) { return s.core_radius.has_value(); }},
    {{"repulsion", "(35)(36)", "the paper",
      "added to the other forces, D scaled by m c0^2 dx, pe at most 2, pairs in contact damped, its own limit of the time step"},
     [](const EffectSettings& s) { return s.repulsion.has_value(); }},
    {{"surface_tension", "(21)-(23)", "Brackbill 1992; Morris 2000; Breinlinger 2013",
      "curvature of kept normals instead of the Laplacian of the colour field; contact angle; no net force on a free body"},
     [](const EffectSettings& s) { return s.surface_tension.has_value(); }},
    {{"adhesion", "-", "bleedsim", "not in the paper as a formula: a pull to tissue within h"},
     [](const EffectSettings& s) { return s.adhesion.has_value(); }},
    {{"applied_force", "-", "bleedsim", "not in the paper: force of instruments and commands on the fluid"},
     [](const EffectSettings& s) { return s.applied_force.has_value(); }},
}};

}  // namespace bleedsim::sph
