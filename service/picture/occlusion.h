// Darkening of creases and of what lies close behind an edge, from differences of depth in the picture.
#pragma once

#include <vector>

#include "service/picture/splat.h"

namespace bleedsim::picture {

/// For every pixel 0 (open) to 1 (deep in a crease): how much nearer, in units of `length_m`, opposite neighbours are on average
/// than the pixel itself. Slanted planes have none. Neighbours that are nearer by more than six lengths have nothing to do with
/// the place and do not count. `reach_px`: how far the neighbours lie, pixels.
std::vector<float> occlusionOf(const std::vector<float>& depth, int width, int height, double length_m, double reach_px);

}  // namespace bleedsim::picture
