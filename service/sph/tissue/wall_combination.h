// The shares of all walls within reach of a particle, combined: perpendicular walls by the product of what they leave free, every
// other pair with the correction delta = L12 - L1 L2 of share_rule.h,
//   1 - L = prod_k (1 - L_k) + sum_{k<l} delta_kl prod_{m != k,l} (1 - L_m).
// This is walls.md's rule for any two walls and for any number of perpendicular ones. For three or more skew walls it is the sum
// of their pair corrections, which, other than the choice of a nearest pair, is continuous and does not depend on the order. The
// gradient is exact with the normals held; the friction takes the weights dL/dL_k.
#pragma once

#include <array>
#include <cmath>

#include "service/sph/tissue/share_rule.h"

namespace bleedsim::sph {

/// What one wall (a plane, a block, a bowl) adds to a particle. Its fields have no defaults: a list of eight would be written in
/// full for every particle, which costs more than one wall's term.
template <class Real>
struct WallTerm {
  Real distance;                 ///< m
  std::array<Real, 3> normal;    ///< unit, into the blood
  Real share;                    ///< L_k
  std::array<Real, 3> gradient;  ///< grad L_k, 1/m
  Real friction;                 ///< 1/m^2, <= 0
  Real grip;                     ///< 1 - slip
};

/// The walls that a particle touches. More than kMost at once are not resolved: the nearest ones count.
template <class Real>
class WallTerms {
 public:
  static constexpr int kMost = 8;

  int size() const { return size_; }
  const WallTerm<Real>& operator[](int k) const { return terms_[k]; }

  void add(const WallTerm<Real>& term) {
    if (size_ < kMost) {
      terms_[size_++] = term;
      return;
    }
    int furthest = 0;
    for (int k = 1; k < kMost; ++k) {
      if (terms_[k].distance > terms_[furthest].distance) furthest = k;
    }
    if (term.distance < terms_[furthest].distance) terms_[furthest] = term;
  }

  /// prod (1 - L_m) over all m but those three.
  Real freeWithout(int a, int b, int c) const {
    Real product = 1;
    for (int m = 0; m < size_; ++m) {
      if (m != a && m != b && m != c) product *= 1 - terms_[m].share;
    }
    return product;
  }

 private:
  int size_ = 0;
  std::array<WallTerm<Real>, kMost> terms_;  // the first size_ of them
};

template <class Real>
struct CombinedShare {
  Real share = 0;                                     ///< L, in [0, 1]
  std::array<Real, WallTerms<Real>::kMost> weight{};  ///< dL/dL_k
};

template <class Real>
CombinedShare<Real> combineShares(const WallTerms<Real>& terms) {
  CombinedShare<Real> result;
  const int count = terms.size();
  if (count == 1) {
    result.share = terms[0].share;
    result.weight[0] = 1;
    return result;
  }
  constexpr int kNone = -1;
  constexpr Real kPerpendicular = static_cast<Real>(1e-6);
  Real left_free = terms.freeWithout(kNone, kNone, kNone);
  for (int k = 0; k < count; ++k) result.weight[k] = terms.freeWithout(k, kNone, kNone);
  for (int k = 0; k < count; ++k) {
    for (int l = k + 1; l < count; ++l) {
      const auto& a = terms[k];
      const auto& b = terms[l];
      const Real c = a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
      if (std::abs(c) <= kPerpendicular) continue;
      const Overlap<Real> overlap = overlapOf(a.share, b.share, c);
      const Real delta = overlap.value - a.share * b.share;
      const Real rest = terms.freeWithout(k, l, kNone);
      left_free += delta * rest;
      result.weight[k] -= (overlap.by_first - b.share) * rest;
      result.weight[l] -= (overlap.by_second - a.share) * rest;
      for (int m = 0; m < count; ++m) {
        if (m != k && m != l) result.weight[m] += delta * terms.freeWithout(k, l, m);
      }
    }
  }
  result.share = std::min(std::max(Real{0}, 1 - left_free), Real{1});
  return result;
}

}  // namespace bleedsim::sph
