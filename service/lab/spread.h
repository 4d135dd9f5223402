// Distances between particles and the shape of a gush: figures of a body of particles that no height map shows.
#pragma once

#include <cstdint>
#include <span>

namespace bleedsim::lab {

struct NeighborDistances {
  double smallest = 0.0;          ///< m; 0 with fewer than two particles
  double first_percentile = 0.0;  ///< m, of the distances to the nearest neighbour
  double median = 0.0;            ///< m
  std::uint32_t alone = 0;        ///< particles without another within `reach`
};

/// Nearest neighbours up to `reach` m; distances beyond it count as `reach`. `position`: x, y, z of each particle, m.
NeighborDistances neighborDistances(std::span<const float> position, double reach);

/// Width of what rises from a wound on flat tissue: twice the distance from the axis within which 90 % of the particles between
/// two heights stand, of those within `reach` of the axis. 0 without any.
struct GushWindow {
  double center_x = 0.0, center_y = 0.0;  ///< m
  double lower = 0.0, upper = 0.0;        ///< heights, m
  double reach = 0.0;                     ///< m
};
double gushWidth(std::span<const float> position, const GushWindow& window);

}  // namespace bleedsim::lab
