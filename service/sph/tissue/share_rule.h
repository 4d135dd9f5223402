// How the shares of two walls combine, design document walls.md: with c = n1.n2 and w = (2/pi) asin|c|, the part that both claim
// is
//   L12 = (1 - w) L1 L2 + w M,   M = min(L1, L2) for c > 0, else max(0, L1 + L2 - 1),
// exact for perpendicular walls in the product's sense (w = 0), for one plane given twice (c = 1) and for facing planes (c = -1).
// A concave edge has the share L1 + L2 - L12; a convex one, where tissue is behind both planes at once, L12.
#pragma once

#include <algorithm>
#include <cmath>

namespace bleedsim::sph {

/// asin(c), c in [0, 1], within 3e-8: Abramowitz & Stegun 4.4.46. The library's own bits change between machines.
template <class Real>
Real arcSine(Real c) {
  const Real x = std::min(c, Real{1});
  Real sum = static_cast<Real>(-0.0012624911);
  sum = sum * x + static_cast<Real>(0.0066700901);
  sum = sum * x + static_cast<Real>(-0.0170881256);
  sum = sum * x + static_cast<Real>(0.0308918810);
  sum = sum * x + static_cast<Real>(-0.0501743046);
  sum = sum * x + static_cast<Real>(0.0889789874);
  sum = sum * x + static_cast<Real>(-0.2145988016);
  sum = sum * x + static_cast<Real>(1.5707963050);
  return std::max(Real{0}, static_cast<Real>(1.5707963267948966) - std::sqrt(Real{1} - x) * sum);
}

/// w of two walls with c = n1.n2: 0 if perpendicular, 1 if parallel.
template <class Real>
Real wedgeWeight(Real c) {
  return arcSine(std::abs(c)) * static_cast<Real>(0.6366197723675814);
}

/// L12 and its partial derivatives.
template <class Real>
struct Overlap {
  Real value = 0;
  Real by_first = 0;
  Real by_second = 0;
  Real by_weight = 0;  ///< by w
};

template <class Real>
Overlap<Real> overlapOf(Real first, Real second, Real c) {
  const Real w = wedgeWeight(c);
  Real common = 0;
  Real common_by_first = 0;
  Real common_by_second = 0;
  if (c > 0) {
    common = std::min(first, second);
    (first <= second ? common_by_first : common_by_second) = 1;
  } else if (first + second > 1) {
    common = first + second - 1;
    common_by_first = 1;
    common_by_second = 1;
  }
  Overlap<Real> result;
  result.value = (1 - w) * first * second + w * common;
  result.by_first = (1 - w) * second + w * common_by_first;
  result.by_second = (1 - w) * first + w * common_by_second;
  result.by_weight = common - first * second;
  return result;
}

}  // namespace bleedsim::sph
