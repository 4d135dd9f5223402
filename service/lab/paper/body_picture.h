// Pictures of a scene's blood on its tissue, all of one experiment from the same place.
#pragma once

#include <span>
#include <vector>

#include "service/picture/scene_picture.h"
#include "service/sph/world_description.h"

namespace bleedsim::lab {

/// What picture draws of a scene's tissue.
std::vector<picture::Shape> shapesOf(const sph::WorldDescription& scene);

/// A camera for a body of blood about a wound.
struct BodyView {
  picture::Vec3 center = picture::Vec3::Zero();  ///< m, on the tissue
  double radius = 0.0;                           ///< m, of what is shown about it
  double height = 0.0;                           ///< m, of what is shown over it
  bool from_above = false;                       ///< else obliquely from the front
};

Result<picture::Image> drawBody(std::span<const float> positions, const sph::WorldDescription& scene, const BodyView& view);

}  // namespace bleedsim::lab
