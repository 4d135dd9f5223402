#include "service/lab/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "service/lab/height_map.h"

namespace bleedsim::lab {
namespace {

constexpr double kDrawRadius = 0.75;  // spacings: more than half a lattice cell's diagonal, sqrt(2)/2

double drawRadius(const FootprintOptions& options) {
  return options.draw_radius > 0.0 ? options.draw_radius : kDrawRadius * options.spacing;
}

HeightMap mapOf(std::span<const float> position, const FootprintOptions& options) {
  return drawHeightMap(position, 0.5 * options.spacing, drawRadius(options), options.ground);
}

/// How much of each cell is covered, smoothed by a 3 x 3 binomial: its contour at 1/2 has no staircase, so that a disc has the
/// perimeter of a disc.
std::vector<double> smoothedCover(const HeightMap& map) {
  static constexpr std::array<double, 3> kWeight{0.25, 0.5, 0.25};
  std::vector<double> cover(map.height.size(), 0.0);
  for (std::size_t row = 1; row + 1 < map.rows; ++row) {
    for (std::size_t column = 1; column + 1 < map.columns; ++column) {
      double sum = 0.0;
      for (std::size_t dy = 0; dy < 3; ++dy) {
        for (std::size_t dx = 0; dx < 3; ++dx) {
          if (map.covered(column + dx - 1, row + dy - 1)) sum += kWeight[dx] * kWeight[dy];
        }
      }
      cover[row * map.columns + column] = sum;
    }
  }
  return cover;
}

/// Length of the contour at 1/2 by marching squares, in cells.
double contourLength(const std::vector<double>& field, std::size_t columns, std::size_t rows) {
  constexpr double kLevel = 0.5;
  double length = 0.0;
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const double corner[4] = {field[row * columns + column], field[row * columns + column + 1],
                                field[(row + 1) * columns + column + 1], field[(row + 1) * columns + column]};
      static constexpr std::array<std::array<double, 2>, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      std::array<std::array<double, 2>, 4> crossing{};
      std::size_t crossings = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        if ((corner[k] >= kLevel) == (corner[next] >= kLevel)) continue;
        const double t = (kLevel - corner[k]) / (corner[next] - corner[k]);
        crossing[crossings++] = {kCorner[k][0] + t * (kCorner[next][0] - kCorner[k][0]),
                                 kCorner[k][1] + t * (kCorner[next][1] - kCorner[k][1])};
      }
      for (std::size_t k = 0; k + 1 < crossings; k += 2)
        length += std::hypot(crossing[k][0] - crossing[k + 1][0], crossing[k][1] - crossing[k + 1][1]);
    }
  }
  return length;
}

std::uint32_t countPieces(const HeightMap& map) {
  std::vector<char> seen(map.height.size(), 0);
  std::vector<std::size_t> stack;
  std::uint32_t pieces = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start] != 0 || map.height[start] < 0.0f) continue;
    ++pieces;
    seen[start] = 1;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      // The map's border is empty, so every covered cell has four neighbours.
      for (const std::size_t next : {at - 1, at + 1, at - map.columns, at + map.columns}) {
        if (seen[next] != 0 || map.height[next] < 0.0f) continue;
        seen[next] = 1;
        stack.push_back(next);
      }
    }
  }
  return pieces;
}

/// rms of the height against the mean of its 5 x 5 cells, where all of them are covered.
double roughnessOf(const HeightMap& map) {
  double sum2 = 0.0;
  std::size_t cells = 0;
  for (std::size_t row = 2; row + 2 < map.rows; ++row) {
    for (std::size_t column = 2; column + 2 < map.columns; ++column) {
      double sum = 0.0;
      bool inside = true;
      for (std::size_t y = row - 2; y <= row + 2 && inside; ++y) {
        for (std::size_t x = column - 2; x <= column + 2 && inside; ++x) {
          inside = map.covered(x, y);
          sum += static_cast<double>(map.height[y * map.columns + x]);
        }
      }
      if (!inside) continue;
      const double difference = static_cast<double>(map.height[row * map.columns + column]) - sum / 25.0;
      sum2 += difference * difference;
      ++cells;
    }
  }
  return cells > 0 ? std::sqrt(sum2 / static_cast<double>(cells)) : 0.0;
}

/// Area of the upper surface: of each covered cell the slope by central differences of the heights, uncovered ones as 0.
double upperSurface(const HeightMap& map) {
  const auto height = [&map](std::size_t column, std::size_t row) {
    return std::max(0.0, static_cast<double>(map.height[row * map.columns + column]));
  };
  double area = 0.0;
  for (std::size_t row = 1; row + 1 < map.rows; ++row) {
    for (std::size_t column = 1; column + 1 < map.columns; ++column) {
      if (!map.covered(column, row)) continue;
      const double sx = 0.5 * (height(column + 1, row) - height(column - 1, row)) / map.cell;
      const double sy = 0.5 * (height(column, row + 1) - height(column, row - 1)) / map.cell;
      area += std::sqrt(1.0 + sx * sx + sy * sy);
    }
  }
  return area * map.cell * map.cell;
}

}  // namespace

Footprint footprintOf(std::span<const float> position, const FootprintOptions& options) {
  const HeightMap map = mapOf(position, options);
  Footprint result;
  std::size_t covered = 0;
  double height_sum = 0.0;
  for (const float height : map.height) {
    if (height < 0.0f) continue;
    ++covered;
    height_sum += static_cast<double>(height);
    result.largest_height = std::max(result.largest_height, static_cast<double>(height));
  }
  if (covered == 0) return result;
  result.area = static_cast<double>(covered) * map.cell * map.cell;
  result.mean_height = height_sum / static_cast<double>(covered);
  result.equivalent_radius = std::sqrt(result.area / std::numbers::pi);
  result.perimeter = contourLength(smoothedCover(map), map.columns, map.rows) * map.cell;
  result.serration = result.perimeter * result.perimeter / result.area;
  result.roughness = roughnessOf(map);
  result.pieces = countPieces(map);
  const double volume = result.area * result.mean_height;
  const double surface = result.area + upperSurface(map);
  result.sphericity = std::cbrt(std::numbers::pi) * std::pow(6.0 * volume, 2.0 / 3.0) / surface;
  return result;
}

HeightProfile heightProfile(std::span<const float> position, const FootprintOptions& options, double center_x, double center_y,
                            double ring_width, std::size_t rings) {
  const HeightMap map = mapOf(position, options);
  std::vector<double> sum(rings, 0.0);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const double ring = std::hypot(map.x(column) - center_x, map.y(row) - center_y) / ring_width;
      if (!(ring < static_cast<double>(rings)) || !map.covered(column, row)) continue;
      sum[static_cast<std::size_t>(ring)] += static_cast<double>(map.height[row * map.columns + column]);
    }
  }
  HeightProfile profile;
  for (std::size_t k = 0; k < rings; ++k) {
    const double inner = static_cast<double>(k) * ring_width;
    const double outer = inner + ring_width;
    const double cells = std::numbers::pi * (outer * outer - inner * inner) / (map.cell * map.cell);
    profile.radius.push_back(0.5 * (inner + outer));
    profile.height.push_back(sum[k] / cells);
  }
  return profile;
}

}  // namespace bleedsim::lab
