// A picture of blood on tissue, computed in software: spheres or a smooth liquid on analytic shapes, with light, shade and a
// scale. The same input gives the same bytes on every run of one build.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "service/picture/camera.h"
#include "service/picture/color_map.h"
#include "service/picture/image.h"
#include "service/picture/lighting.h"
#include "service/picture/shapes.h"
#include "service/picture/splat.h"
#include "service/status/status.h"

namespace bleedsim::picture {

enum class BloodLook {
  spheres,  ///< every particle as it is: for studying particles
  liquid,   ///< a smoothed, wet surface, thin layers let the tissue shine through; lone particles look larger than they are
};

struct SceneStyle {
  int width = 800;   ///< pixels
  int height = 600;  ///< pixels
  int samples = 2;   ///< per pixel and axis, 1 to 4: smooth edges for squared time
  BloodLook look = BloodLook::spheres;
  Color blood{168, 10, 16};
  Color tissue{222, 168, 150};
  Color background{236, 238, 241};
  bool grid = true;             ///< lines on the tissue at round distances
  bool scale_bar = true;        ///< orthographic: exact everywhere; perspective: at the distance of the camera's target
  std::string caption;          ///< empty: none
  std::string value_name;       ///< over the colour bar, with unit; used when the cloud has values
  std::optional<Range> values;  ///< of the colours; nothing: from the least to the greatest
  Light light;
};

struct ScenePicture {
  Image image;
  std::vector<float> depth_m;  ///< of each pixel, rows from the top: the nearest of its samples, blood or tissue; or kNoDepth
  SplatCounts counts;
};

/// invalid_argument: the picture's size, samples, camera, shapes, colour range or the cloud's arrays; the message says which and
/// what is allowed. Particles that cannot be drawn are no error, they are counted.
Result<ScenePicture> drawScene(const ParticleCloud& cloud, const std::vector<Shape>& tissue, const Camera& camera,
                               const SceneStyle& style);

}  // namespace bleedsim::picture
