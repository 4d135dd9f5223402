// What a body of particles on tissue looks like from above: the numbers behind the paper's words for its pictures.
//
// The particles are drawn into a height map of square cells (spacing/2): a particle covers the cells whose centre is within the
// draw radius of it, with the height of its sphere there. All figures come from this map, so they depend on no mesh and no order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bleedsim::lab {

struct FootprintOptions {
  double spacing = 0.0;      ///< dx, m
  double draw_radius = 0.0;  ///< m; 0: 0.75 dx, at which a rest lattice has no holes
  double ground = 0.0;       ///< z of the tissue, m
};

struct Footprint {
  double area = 0.0;               ///< m^2, of all covered cells
  double perimeter = 0.0;          ///< m, contour of the covered area, holes included, by marching squares
  double serration = 0.0;          ///< perimeter^2/area; 4 pi for a disc, larger for a ragged edge
  double roughness = 0.0;          ///< m, rms of the height against its mean over 5 x 5 cells, away from the edge
  double mean_height = 0.0;        ///< m, over the covered area
  double largest_height = 0.0;     ///< m
  double sphericity = 0.0;         ///< pi^(1/3) (6 V)^(2/3)/A of the body under the height map, base included; 1 for a sphere
  double equivalent_radius = 0.0;  ///< m, sqrt(area/pi)
  std::uint32_t pieces = 0;        ///< parts of the covered area that do not touch (4-connected)
};

/// `position`: x, y, z of each particle, m. Nothing is covered without particles: all figures are 0 then.
Footprint footprintOf(std::span<const float> position, const FootprintOptions& options);

/// Mean height of the map in rings about a point.
struct HeightProfile {
  std::vector<double> radius;  ///< m, middle of each ring
  std::vector<double> height;  ///< m, mean over all cells of the ring, uncovered ones as 0
};
HeightProfile heightProfile(std::span<const float> position, const FootprintOptions& options, double center_x, double center_y,
                            double ring_width, std::size_t rings);

}  // namespace bleedsim::lab
