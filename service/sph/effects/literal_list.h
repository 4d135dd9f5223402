// What each effect is in the literal model, by its name in effect_list.h. Equations of the paper.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace bleedsim::sph {

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kLiteralTexts{{
    {"gravity", "F of (9)"},
    {"pressure",
     "(17) or (16), p = k (rho - rho0) of (19) unclamped, density (20) by poly6 (29), gradient by spiky (31), its sign mended"},
    {"viscosity", "(25) with the particle's own mu and the Laplacian (33)"},
    {"surface_tension", "(21)-(23): f = -eps lap C n/|n| with spiky, where |n| h is above a cut-off"},
    {"platelets", "(26) mu = b exp(-a P); (27) dP/dt = k lap P with the Laplacian (33): it never clots a uniform P"},
    {"core_radius",
     "(34) with lambda = h/dx after every step, kernels of the particle's own radius; 0.5 h to 3.75 spacings, as far as the cell "
     "grid follows"},
    {"repulsion", "(35)(36) D (pe^n1 - pe^n2)/d^2; by Table I particles in contact feel nothing else"},
    {"applied_force", "not in the paper, as in the sound model"},
}};

/// Empty for an effect that the literal model does not have.
constexpr std::string_view literalText(std::string_view effect) {
  for (const auto& [name, text] : kLiteralTexts) {
    if (name == effect) return text;
  }
  return {};
}

}  // namespace bleedsim::sph
