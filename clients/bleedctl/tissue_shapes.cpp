#include "clients/bleedctl/tissue_shapes.h"

#include <optional>

namespace bleedsim::bleedctl {
namespace {

picture::Vec3 toVec3(const scene::Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::optional<picture::Shape> toShape(const scene::Tissue& tissue) {
  switch (tissue.shape_case()) {
    case scene::Tissue::kPlane: {
      picture::PlaneShape plane;
      plane.point = toVec3(tissue.plane().point_m());
      plane.normal = toVec3(tissue.plane().normal());
      return plane;
    }
    case scene::Tissue::kBox:
      return picture::BoxShape{.lower = toVec3(tissue.box().lower_m()),
                               .upper = toVec3(tissue.box().upper_m()),
                               .container = tissue.box().side() == scene::BoxTissue::CONTAINER,
                               .open_top = tissue.box().open_top()};
    case scene::Tissue::kBowl:
      return picture::BowlShape{.rim_center = toVec3(tissue.bowl().rim_center_m()),
                                .sphere_radius_m = tissue.bowl().sphere_radius_m(),
                                .depth_m = tissue.bowl().depth_m()};
    case scene::Tissue::SHAPE_NOT_SET:
      break;
  }
  return {};
}

}  // namespace

std::vector<picture::Shape> tissueShapes(const scene::Scene& scene) {
  std::vector<picture::Shape> shapes;
  for (const scene::Tissue& tissue : scene.tissue()) {
    const std::optional<picture::Shape> shape = toShape(tissue);
    if (shape && picture::checkShape(*shape).ok()) shapes.push_back(*shape);
  }
  return shapes;
}

}  // namespace bleedsim::bleedctl
