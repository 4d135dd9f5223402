// The tissue and the space behind it, as the camera sees them without blood.
#pragma once

#include <vector>

#include "service/picture/lighting.h"
#include "service/picture/shapes.h"
#include "service/picture/splat.h"

namespace bleedsim::picture {

struct GroundStyle {
  Color tissue;
  Color background;
  bool grid = true;
  double grid_m = 0.01;  ///< between strong lines; weak ones at a tenth
};

struct Ground {
  Surface surface;
  std::vector<LinearColor> albedo;  ///< of tissue; elsewhere the finished background
};

/// A round distance of lines for a picture that shows so many pixels a metre.
double gridPitch(double pixels_per_m);

Ground castGround(const View& view, const std::vector<Shape>& shapes, const GroundStyle& style);

}  // namespace bleedsim::picture
