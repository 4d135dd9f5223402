#include "tests/support/nearest_offset.h"

#include <cmath>

namespace bleedsim::test {

sph::Vec3 nearestOffset(const sph::Domain& domain, sph::Vec3 offset) {
  for (Eigen::Index a = 0; a < 3; ++a) {
    if (!domain.periodic[static_cast<std::size_t>(a)]) continue;
    const double side = domain.upper[a] - domain.lower[a];
    offset[a] -= side * std::round(offset[a] / side);
  }
  return offset;
}

}  // namespace bleedsim::test
