// Height map of particles seen from above; the base of footprint.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bleedsim::lab {

/// Row-major, x fastest, with two empty cells all round.
struct HeightMap {
  double cell = 0.0;      ///< side of a cell, m
  double origin_x = 0.0;  ///< of the first cell's corner, m
  double origin_y = 0.0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> height;  ///< m above the ground; negative where nothing is

  bool covered(std::size_t column, std::size_t row) const { return height[row * columns + column] >= 0.0f; }
  double x(std::size_t column) const { return origin_x + (static_cast<double>(column) + 0.5) * cell; }
  double y(std::size_t row) const { return origin_y + (static_cast<double>(row) + 0.5) * cell; }
};

/// Draws spheres of `radius` about the particles; heights are above `ground` and at least 0. Particles that are not finite are
/// left out. The map is empty without particles. `cell` grows as needed to keep the map within 16 million cells.
HeightMap drawHeightMap(std::span<const float> position, double cell, double radius, double ground);

}  // namespace bleedsim::lab
