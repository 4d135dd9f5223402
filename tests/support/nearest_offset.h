// Offsets across periodic sides, as the oracles see them.
#pragma once

#include "service/sph/world_description.h"

namespace bleedsim::test {

/// `offset` (m) between two particles, or to the nearest image across the domain's periodic sides.
sph::Vec3 nearestOffset(const sph::Domain& domain, sph::Vec3 offset);

}  // namespace bleedsim::test
