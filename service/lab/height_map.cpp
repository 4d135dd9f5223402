#include "service/lab/height_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bleedsim::lab {
namespace {

constexpr double kMostCells = 16'000'000.0;
constexpr int kBorder = 2;

struct Extent {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();
  void include(double value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

bool finite(const float* p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// The cells from first to last whose centres are within `radius` of `center` along one axis.
struct CellRange {
  std::size_t first, last;
};
CellRange cellsWithin(double center, double radius, double origin, double cell) {
  const double low = std::ceil((center - radius - origin) / cell - 0.5);
  const double high = std::floor((center + radius - origin) / cell - 0.5);
  return {static_cast<std::size_t>(std::max(0.0, low)), static_cast<std::size_t>(std::max(-1.0, high) + 1.0)};
}

}  // namespace

HeightMap drawHeightMap(std::span<const float> position, double cell, double radius, double ground) {
  Extent x;
  Extent y;
  const std::size_t count = position.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    if (!finite(&position[3 * i])) continue;
    x.include(static_cast<double>(position[3 * i]));
    y.include(static_cast<double>(position[3 * i + 1]));
  }
  HeightMap map;
  map.cell = cell;
  if (x.lower > x.upper) return map;
  const auto cells_along = [&](const Extent& extent) {
    return std::ceil((extent.upper - extent.lower + 2.0 * radius) / map.cell) + 1.0 + 2.0 * kBorder;
  };
  while (cells_along(x) * cells_along(y) > kMostCells) map.cell *= 2.0;
  map.columns = static_cast<std::size_t>(cells_along(x));
  map.rows = static_cast<std::size_t>(cells_along(y));
  // Cells stand on multiples of their side, so that a figure does not jump with the outermost particle.
  map.origin_x = std::floor((x.lower - radius) / map.cell - kBorder) * map.cell;
  map.origin_y = std::floor((y.lower - radius) / map.cell - kBorder) * map.cell;
  map.height.assign(map.columns * map.rows, -1.0f);
  for (std::size_t i = 0; i < count; ++i) {
    const float* p = &position[3 * i];
    if (!finite(p)) continue;
    const double px = static_cast<double>(p[0]);
    const double py = static_cast<double>(p[1]);
    const CellRange columns = cellsWithin(px, radius, map.origin_x, map.cell);
    const CellRange rows = cellsWithin(py, radius, map.origin_y, map.cell);
    for (std::size_t row = rows.first; row < std::min(rows.last, map.rows); ++row) {
      for (std::size_t column = columns.first; column < std::min(columns.last, map.columns); ++column) {
        const double dx = map.x(column) - px;
        const double dy = map.y(row) - py;
        const double rest = radius * radius - dx * dx - dy * dy;
        if (rest < 0.0) continue;
        const double top = std::max(0.0, static_cast<double>(p[2]) + std::sqrt(rest) - ground);
        float& height = map.height[row * map.columns + column];
        height = std::max(height, static_cast<float>(top));
      }
    }
  }
  return map;
}

}  // namespace bleedsim::lab
