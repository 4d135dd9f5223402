#include "service/lab/spread.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace bleedsim::lab {
namespace {

/// Particles by cells of side `reach`.
class CellHash {
 public:
  CellHash(std::span<const float> position, double reach) : position_{position}, reach_{reach} {
    for (std::size_t i = 0; 3 * i + 2 < position.size(); ++i) cells_[keyOf(i, 0, 0, 0)].push_back(i);
  }

  double nearest(std::size_t i) const {
    double nearest2 = reach_ * reach_;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const auto cell = cells_.find(keyOf(i, dx, dy, dz));
          if (cell == cells_.end()) continue;
          for (const std::size_t j : cell->second) {
            if (j != i) nearest2 = std::min(nearest2, distance2(i, j));
          }
        }
      }
    }
    return std::sqrt(nearest2);
  }

 private:
  double at(std::size_t i, std::size_t axis) const { return static_cast<double>(position_[3 * i + axis]); }
  std::uint64_t keyOf(std::size_t i, int dx, int dy, int dz) const {
    const auto cell = [&](std::size_t axis, int offset) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(at(i, axis) / reach_)) + offset) & 0x1fffff;
    };
    return cell(0, dx) | cell(1, dy) << 21 | cell(2, dz) << 42;
  }
  double distance2(std::size_t i, std::size_t j) const {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += (at(i, axis) - at(j, axis)) * (at(i, axis) - at(j, axis));
    return sum;
  }

  std::span<const float> position_;
  double reach_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace

NeighborDistances neighborDistances(std::span<const float> position, double reach) {
  NeighborDistances result;
  const std::size_t count = position.size() / 3;
  if (count < 2) {
    result.alone = static_cast<std::uint32_t>(count);
    return result;
  }
  const CellHash cells{position, reach};
  std::vector<double> nearest(count);
  for (std::size_t i = 0; i < count; ++i) nearest[i] = cells.nearest(i);
  std::sort(nearest.begin(), nearest.end());
  result.smallest = nearest.front();
  result.first_percentile = nearest[count / 100];
  result.median = nearest[count / 2];
  result.alone = static_cast<std::uint32_t>(nearest.end() - std::lower_bound(nearest.begin(), nearest.end(), reach));
  return result;
}

double gushWidth(std::span<const float> position, const GushWindow& window) {
  std::vector<double> distances;
  for (std::size_t i = 0; 3 * i + 2 < position.size(); ++i) {
    const double z = static_cast<double>(position[3 * i + 2]);
    if (z < window.lower || z > window.upper) continue;
    const double distance = std::hypot(static_cast<double>(position[3 * i]) - window.center_x,
                                       static_cast<double>(position[3 * i + 1]) - window.center_y);
    if (distance <= window.reach) distances.push_back(distance);
  }
  if (distances.empty()) return 0.0;
  std::sort(distances.begin(), distances.end());
  return 2.0 * distances[(distances.size() - 1) * 9 / 10];
}

}  // namespace bleedsim::lab
