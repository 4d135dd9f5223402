// Positions on periodic sides of the domain.
#pragma once

#include <cmath>
#include <cstddef>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Moves a position (m) by whole sides into the domain; axes that are not periodic stay.
inline void wrapInto(const Domain& domain, Vec3& position) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double side = domain.upper[axis] - domain.lower[axis];
    position[axis] -= side * std::floor((position[axis] - domain.lower[axis]) / side);
  }
}

/// From one position to the nearest image of another, m.
inline Vec3 nearestOffset(const Domain& domain, const Vec3& from, const Vec3& to) {
  Vec3 offset = to - from;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double side = domain.upper[axis] - domain.lower[axis];
    offset[axis] -= side * std::round(offset[axis] / side);
  }
  return offset;
}

}  // namespace bleedsim::sph
