// The support radii at which tables are made where particles have radii of their own (34): five, one of them h itself, so that
// the rest lattice stays at rest. Between them everything is linear in the radius (walls.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace bleedsim::sph {

/// Bounds of a particle's own support radius over h; both 1 without (34).
struct RadiusBounds {
  double smallest = 1.0;  ///< 0 < smallest <= 1
  double largest = 1.0;   ///< >= 1

  bool vary() const { return smallest < 1.0 || largest > 1.0; }
};

constexpr std::size_t kRadiusNodes = 5;
constexpr std::size_t kUnitNode = 1;  ///< the node of h itself

/// The nodes over h, ascending: the smallest, 1, and three more up to the largest.
inline std::array<double, kRadiusNodes> radiusNodes(const RadiusBounds& bounds) {
  std::array<double, kRadiusNodes> nodes{bounds.smallest};
  for (std::size_t k = kUnitNode; k < kRadiusNodes; ++k) {
    const auto part = static_cast<double>(k - kUnitNode) / static_cast<double>(kRadiusNodes - 1 - kUnitNode);
    nodes[k] = 1.0 + part * (bounds.largest - 1.0);
  }
  return nodes;
}

/// Where a radius lies between the nodes; by default at h itself.
template <class Real>
struct RadiusPlace {
  std::size_t node = kUnitNode;
  Real part = 0;  ///< of the way to the next node
};

template <class Real>
class RadiusScale {
 public:
  RadiusScale() = default;
  explicit RadiusScale(const RadiusBounds& bounds) {
    const auto nodes = radiusNodes(bounds);
    for (std::size_t k = 0; k < kRadiusNodes; ++k) nodes_[k] = static_cast<Real>(nodes[k]);
  }

  /// Of a radius over h; outside the bounds, that of the bound.
  RadiusPlace<Real> at(Real radius) const {
    if (!(nodes_.front() < nodes_.back())) return {};
    std::size_t k = 0;
    while (k + 2 < kRadiusNodes && radius >= nodes_[k + 1]) ++k;
    const Real width = nodes_[k + 1] - nodes_[k];
    if (!(width > Real(0))) return {};
    return {k, std::min(std::max((radius - nodes_[k]) / width, Real(0)), Real(1))};
  }

 private:
  std::array<Real, kRadiusNodes> nodes_{};
};

}  // namespace bleedsim::sph
