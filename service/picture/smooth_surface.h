// Spheres to a liquid's surface: the depth buffer is smoothed in the picture, as in
// N. Truong, C. Yuksel, "A Narrow-Range Filter for Screen-Space Fluid Rendering", PACM CGIT 1 (1), 2018.
// Deviation: the filter is applied along rows and columns in turn, and its kernel has the same number of pixels everywhere.
#pragma once

#include "service/picture/splat.h"

namespace bleedsim::picture {

struct SmoothSettings {
  double sigma_m = 0.0;  ///< of the Gauss kernel across the line of sight
  double range_m = 0.0;  ///< steps in depth larger than this stay sharp
  int iterations = 3;
};

/// Smooths the depths and takes new normals from them. Pixels without depth stay so.
void smoothSurface(const View& view, const SmoothSettings& settings, Surface& surface);

/// Smooths a quantity over the pixels that have a depth; NaN takes no part and stays.
void smoothQuantity(const View& view, double sigma_m, const Surface& surface, std::vector<float>& quantity);

}  // namespace bleedsim::picture
