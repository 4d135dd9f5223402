#include "service/lab/paper/body_picture.h"

#include <type_traits>
#include <variant>

namespace bleedsim::lab {
namespace {

constexpr double kDrawnRadius = 0.6;  // spacings: neighbours at rest overlap a little

}  // namespace

std::vector<picture::Shape> shapesOf(const sph::WorldDescription& scene) {
  std::vector<picture::Shape> shapes;
  for (const sph::TissueDescription& tissue : scene.tissue) {
    std::visit(
        [&](const auto& shape) {
          using Shape = std::remove_cvref_t<decltype(shape)>;
          if constexpr (std::is_same_v<Shape, sph::PlaneShape>) {
            picture::PlaneShape plane;
            plane.point = shape.point;
            plane.normal = shape.normal;
            shapes.emplace_back(plane);
          } else if constexpr (std::is_same_v<Shape, sph::BoxShape>) {
            shapes.emplace_back(picture::BoxShape{
                .lower = shape.lower, .upper = shape.upper, .container = !shape.obstacle, .open_top = shape.open_top});
          } else {
            shapes.emplace_back(picture::BowlShape{
                .rim_center = shape.rim_center, .sphere_radius_m = shape.sphere_radius, .depth_m = shape.depth});
          }
        },
        tissue.shape);
  }
  return shapes;
}

Result<picture::Image> drawBody(std::span<const float> positions, const sph::WorldDescription& scene, const BodyView& view) {
  picture::SceneStyle style;
  style.width = 640;
  style.height = 480;
  style.look = picture::BloodLook::liquid;
  picture::Bounds bounds;
  bounds.lower = view.center - picture::Vec3{view.radius, view.radius, 0.0};
  bounds.upper = view.center + picture::Vec3{view.radius, view.radius, view.height};
  picture::FitOptions fit;
  fit.aspect = static_cast<double>(style.width) / style.height;
  const auto camera = view.from_above ? picture::fitCamera(bounds, picture::NamedView::top, fit)
                                      : picture::fitCamera(bounds, picture::Vec3{0.0, 1.0, -0.55}, fit);
  if (!camera) return camera.status();
  picture::ParticleCloud cloud;
  cloud.positions = positions;
  cloud.radius_m = kDrawnRadius * scene.spacing;
  auto drawn = picture::drawScene(cloud, shapesOf(scene), *camera, style);
  if (!drawn) return drawn.status();
  return std::move(drawn->image);
}

}  // namespace bleedsim::lab
