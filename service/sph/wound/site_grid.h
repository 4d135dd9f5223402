// Finds the sites near a point of a patch's plane. The number of cells is bounded whatever the patch's extent.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

class SiteGrid {
 public:
  SiteGrid() = default;

  /// Of the square |u|, |v| <= extent, for look-ups of up to `reach` m (cells grow beyond it where the square is large).
  SiteGrid(double extent, double reach)
      : extent_{extent},
        reach_{reach},
        side_{std::clamp<std::int64_t>(static_cast<std::int64_t>(2.0 * extent / reach), 1, kMaxSide)},
        cells_per_m_{static_cast<double>(side_) / (2.0 * extent)},
        first_(static_cast<std::size_t>(side_ * side_), kNone) {}

  void insert(const Vec2& site) {
    const auto cell = static_cast<std::size_t>(column(site.y()) * side_ + column(site.x()));
    next_.push_back(first_[cell]);
    first_[cell] = static_cast<std::uint32_t>(sites_.size());
    sites_.push_back(site);
  }

  /// visit(index, distance squared) of every site within reach of `point`, in an order that depends on the sites alone.
  template <class Visit>
  void forEachNear(const Vec2& point, Visit&& visit) const {
    if (sites_.empty() || !(std::max(std::abs(point.x()), std::abs(point.y())) <= extent_ + reach_)) return;
    const std::int64_t u_last = column(point.x() + reach_);
    const std::int64_t v_last = column(point.y() + reach_);
    for (std::int64_t v = column(point.y() - reach_); v <= v_last; ++v) {
      for (std::int64_t u = column(point.x() - reach_); u <= u_last; ++u) {
        for (std::uint32_t i = first_[static_cast<std::size_t>(v * side_ + u)]; i != kNone; i = next_[i]) {
          const double squared = (sites_[i] - point).squaredNorm();
          if (squared < reach_ * reach_) visit(i, squared);
        }
      }
    }
  }

  const std::vector<Vec2>& sites() const { return sites_; }

 private:
  static constexpr std::int64_t kMaxSide = 256;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::int64_t column(double coordinate) const {
    return static_cast<std::int64_t>(std::clamp((coordinate + extent_) * cells_per_m_, 0.0, static_cast<double>(side_ - 1)));
  }

  double extent_ = 0.0;
  double reach_ = 0.0;
  std::int64_t side_ = 0;
  double cells_per_m_ = 0.0;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
  std::vector<Vec2> sites_;
};

}  // namespace bleedsim::sph
