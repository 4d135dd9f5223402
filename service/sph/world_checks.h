// Which effects a world can hold together, the bounds of the settings of core radius and repulsion, of fluid blocks and of the
// grid.
#pragma once

#include <cmath>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

inline bool isFiniteNotNegative(double value) { return value >= 0.0 && std::isfinite(value); }

/// invalid_argument for a setting out of its bounds; unsupported for effects that have no compiled pass together. Every refusal
/// says what to do instead.
Status checkEffectSet(const WorldDescription& description);

/// invalid_argument for a viscosity, or for any value, that the effects cannot work with. Where the block lies is the scene's to
/// check.
Status checkBlockViscosity(const FluidBlock& block, const EffectSettings& effects);
Status checkBlock(const FluidBlock& block, const EffectSettings& effects);

inline constexpr double kMostCells = 16'777'216.0;
/// Cells of one support radius (m) that the grid may come to hold: the domain's and those of throats beside it.
double gridCells(const Domain& domain, double support_radius);

}  // namespace bleedsim::sph
