#pragma once

#include <array>
#include <cstddef>

namespace bleedsim::sph {

/// The domain in support radii.
template <class Real>
struct DomainBox {
  std::array<Real, 3> lower{}, upper{};
  std::array<bool, 3> periodic{};

  /// A coordinate that has left a periodic axis by less than a side, brought back.
  Real wrapped(std::size_t axis, Real x) const {
    const Real length = upper[axis] - lower[axis];
    if (x < lower[axis]) x += length;
    if (x >= upper[axis]) x -= length;
    return x;
  }
};

}  // namespace bleedsim::sph
