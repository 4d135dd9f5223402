// How narrow a wound's patch is: what effects.auto measures it by.
#pragma once

#include <vector>

#include "service/sph/world_description.h"

namespace bleedsim::scene {

/// The least width of the points' convex hull over all directions, m: that of one of its edges' directions. Infinite without
/// points.
double leastWidth(const std::vector<sph::Vec2>& points);

/// The narrowest place of a patch, m: the diameter of a disc, the small axis of an ellipse, the width of a polyline. Of a polygon
/// the least width of its hull, or less where two of its edges face each other across the inside (a bent slit): edges whose
/// inward normals are 120 degrees or more apart.
double patchWidth(const sph::PatchShape& shape);

}  // namespace bleedsim::scene
