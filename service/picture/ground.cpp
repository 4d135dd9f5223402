#include "service/picture/ground.h"

#include <algorithm>
#include <cmath>

#include "service/picture/overlay.h"

namespace bleedsim::picture {
namespace {

constexpr double kLineStrength = 0.16;  // of the strong lines
constexpr double kWeakStrength = 0.07;
constexpr float kCutShade = 0.72F;  // of a cut through tissue

/// How much of a line of about one and a half pixels covers the point, faded where lines come closer than six pixels.
double lineAt(double at, double pitch, double pixel_m) {
  const double distance = std::abs(at - pitch * std::round(at / pitch));
  const double cover = std::clamp(1.25 - distance / pixel_m, 0.0, 1.0);
  return cover * std::clamp((pitch / pixel_m - 4.0) / 8.0, 0.0, 1.0);
}

double gridAt(const Eigen::Vector2d& mark, double pitch, double pixel_m) {
  return std::max(lineAt(mark.x(), pitch, pixel_m), lineAt(mark.y(), pitch, pixel_m));
}

}  // namespace

double gridPitch(double pixels_per_m) { return roundLength(200.0 / pixels_per_m).length_m; }

Ground castGround(const View& view, const std::vector<Shape>& shapes, const GroundStyle& style) {
  Ground ground{Surface{view.width(), view.height()}, {}};
  Surface& surface = ground.surface;
  ground.albedo.resize(surface.depth.size());
  const LinearColor tissue = toLinear(style.tissue);
  const LinearColor cut = kCutShade * tissue;
  const LinearColor background = toLinear(style.background);
  for (int y = 0; y < surface.height; ++y) {
    const float height = (static_cast<float>(y) + 0.5F) / static_cast<float>(surface.height);
    const LinearColor behind = background * (1.0F - 0.22F * height);
    for (int x = 0; x < surface.width; ++x) {
      const std::size_t i = surface.index(x, y);
      ground.albedo[i] = behind;
      if (shapes.empty()) continue;
      const Ray ray = view.rayThrough(x + 0.5, y + 0.5);
      const std::optional<ShapeHit> hit = hitShapes(shapes, ray);
      if (!hit) {
        if (cutsThrough(shapes, ray)) ground.albedo[i] = cut;
        continue;
      }
      surface.depth[i] = static_cast<float>(hit->depth);
      surface.normal[i] = view.directionToView(hit->normal).cast<float>();
      double grid = 0.0;
      if (style.grid) {
        // At a slant one pixel covers more of the surface, at least along one of its axes.
        const double slant = std::max(0.15, std::abs(hit->normal.dot(ray.direction.normalized())));
        const double pixel_m = 1.0 / (view.pixelsPerMetre(hit->depth) * std::sqrt(slant));
        grid = std::max(kLineStrength * gridAt(hit->mark, style.grid_m, pixel_m),
                        kWeakStrength * gridAt(hit->mark, 0.1 * style.grid_m, pixel_m));
      }
      ground.albedo[i] = tissue * static_cast<float>(1.0 - grid);
    }
  }
  return ground;
}

}  // namespace bleedsim::picture
