// The numbers behind the paper's words for blood that gushes from a round wound in flat tissue.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "service/lab/paper/gush.h"
#include "service/sph/world_description.h"

namespace bleedsim::lab {

enum class GushFigure : std::size_t {
  area,                ///< covered, m^2
  serration,           ///< perimeter^2/area of the footprint
  roughness,           ///< of the upper surface, m
  sphericity,          ///< of the body under the height map
  mean_height,         ///< over the covered area, m
  height_at_source,    ///< mean over the ring from one to two wound radii about the wound, m
  gush_width,          ///< at the source: of what rises faster than half the exit speed between one and three spacings, m
  nearest,             ///< smallest distance between two particles, m
  nearest_percentile,  ///< first percentile of the distances to the nearest neighbour, m
  pieces,              ///< parts of the footprint that do not touch
  alone,               ///< share of the particles without another within one support radius
  count
};

struct GushFigureInfo {
  std::string_view name;   ///< with unit, for programs
  std::string_view title;  ///< for readers
  double scale;            ///< to the reader's unit
};
const GushFigureInfo& infoOf(GushFigure figure);

using GushFigures = std::array<double, static_cast<std::size_t>(GushFigure::count)>;

/// Where the scene's first wound stands and how wide it is.
struct GushSource {
  double x = 0.0, y = 0.0, z = 0.0;  ///< m
  double radius = 0.0;               ///< m, of a disc or the circle of an ellipse's area; other outlines count as four spacings
  double exit_speed = 0.0;           ///< m/s, of a wound that is driven by a flow
};
GushSource sourceOf(const sph::WorldDescription& scene);

GushFigures figuresOf(const GushBody& body, const sph::WorldDescription& scene);

}  // namespace bleedsim::lab
