#include "service/picture/splat.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bleedsim::picture {
namespace {

struct Sphere {
  Vec3 center;  ///< view coordinates
  double radius;
};

struct Span {
  double low;
  double high;
};

/// The extent of the sphere along one axis of the picture, m at depth 1 (perspective) or m: by the tangents from the eye.
Span extent(double offset, double depth, double radius, bool perspective) {
  if (!perspective) return {offset - radius, offset + radius};
  const double along = depth * depth - radius * radius;
  const double root = radius * std::sqrt(offset * offset + along);
  return {(offset * depth - root) / along, (offset * depth + root) / along};
}

struct PixelBox {
  int left, right, top, bottom;  ///< the last ones are included

  bool empty() const { return left > right || top > bottom; }
};

int pixelBelow(double at, int most) { return static_cast<int>(std::clamp(std::floor(at), -1.0, static_cast<double>(most))); }

PixelBox boxOf(const View& view, const Sphere& sphere) {
  const Span x = extent(sphere.center.x(), sphere.center.z(), sphere.radius, view.perspective());
  const Span y = extent(sphere.center.y(), sphere.center.z(), sphere.radius, view.perspective());
  const double scale = view.pixelsPerMetre(1.0);
  const double middle_x = 0.5 * view.width();
  const double middle_y = 0.5 * view.height();
  return {std::max(0, pixelBelow(middle_x + scale * x.low, view.width())),
          std::min(view.width() - 1, pixelBelow(middle_x + scale * x.high, view.width())),
          std::max(0, pixelBelow(middle_y - scale * y.high, view.height())),
          std::min(view.height() - 1, pixelBelow(middle_y - scale * y.low, view.height()))};
}

class Splatter {
 public:
  Splatter(const View& view, Splats& splats) : view_{view}, splats_{splats} {}

  void draw(const Sphere& sphere, std::uint32_t index, float value) {
    const PixelBox box = boxOf(view_, sphere);
    if (box.empty()) {
      ++splats_.counts.outside;
      return;
    }
    ++splats_.counts.drawn;
    const double per_pixel = 1.0 / view_.pixelsPerMetre(1.0);
    for (int y = box.top; y <= box.bottom; ++y) {
      const double across_y = (0.5 * view_.height() - (y + 0.5)) * per_pixel;
      for (int x = box.left; x <= box.right; ++x) {
        const double across_x = (x + 0.5 - 0.5 * view_.width()) * per_pixel;
        visit(sphere, index, value, splats_.surface.index(x, y), across_x, across_y);
      }
    }
  }

 private:
  void visit(const Sphere& sphere, std::uint32_t index, float value, std::size_t pixel, double across_x, double across_y) {
    // From the point of the ray that is nearest to the centre: free of the cancellation of b^2 - 4ac when the eye is far away.
    const bool perspective = view_.perspective();
    const Vec3 direction = perspective ? Vec3{across_x, across_y, 1.0} : Vec3::UnitZ();
    const Vec3 offset = perspective ? sphere.center : Vec3{sphere.center - Vec3{across_x, across_y, 0.0}};
    const double length2 = direction.squaredNorm();
    const double nearest = offset.dot(direction) / length2;
    const Vec3 away = nearest * direction - offset;
    const double inside = sphere.radius * sphere.radius - away.squaredNorm();
    if (inside < 0.0) return;
    const double half_chord = std::sqrt(inside / length2);
    if (!splats_.thickness.empty()) addThickness(pixel, static_cast<float>(2.0 * half_chord * std::sqrt(length2)), value);
    const float depth = static_cast<float>(nearest - half_chord);
    if (!(depth < splats_.surface.depth[pixel])) return;
    splats_.surface.depth[pixel] = depth;
    splats_.surface.normal[pixel] = ((away - half_chord * direction) / sphere.radius).cast<float>();
    splats_.particle[pixel] = index;
  }

  void addThickness(std::size_t pixel, float chord, float value) {
    splats_.thickness[pixel] += chord;
    if (splats_.value.empty() || !std::isfinite(value)) return;
    splats_.value[pixel] += value * chord;
    weight_.resize(splats_.value.size(), 0.0F);
    weight_[pixel] += chord;
  }

 public:
  void divideValues() {
    for (std::size_t i = 0; i < splats_.value.size(); ++i) {
      const bool any = !weight_.empty() && weight_[i] > 0.0F;
      splats_.value[i] = any ? splats_.value[i] / weight_[i] : std::numeric_limits<float>::quiet_NaN();
    }
  }

 private:
  const View& view_;
  Splats& splats_;
  std::vector<float> weight_;  ///< thickness of those with a finite value
};

}  // namespace

Status checkCloud(const ParticleCloud& cloud) {
  const auto invalid = [](const std::string& message) { return Status{StatusCode::invalid_argument, message}; };
  if (cloud.positions.size() % 3 != 0) {
    return invalid("positions hold " + std::to_string(cloud.positions.size()) + " numbers: give x, y and z of every particle");
  }
  const std::string count = std::to_string(cloud.count());
  if (!cloud.radii.empty() && cloud.radii.size() != cloud.count()) {
    return invalid("there are " + std::to_string(cloud.radii.size()) + " radii for " + count +
                   " particles: give one each, or none");
  }
  if (!cloud.values.empty() && cloud.values.size() != cloud.count()) {
    return invalid("there are " + std::to_string(cloud.values.size()) + " values for " + count +
                   " particles: give one each, or none");
  }
  if (cloud.radii.empty() && cloud.count() > 0 && !(cloud.radius_m > 0.0 && std::isfinite(cloud.radius_m))) {
    return invalid("the particles' radius must be above 0 m and finite");
  }
  if (cloud.count() >= kNoParticle) return invalid("there are too many particles for one picture: draw a part of them");
  return {};
}

Splats splatSpheres(const View& view, const ParticleCloud& cloud, const SplatSettings& settings) {
  Splats splats{Surface{view.width(), view.height()}, {}, {}, {}, {}};
  const std::size_t pixels = splats.surface.depth.size();
  splats.particle.assign(pixels, kNoParticle);
  if (settings.thickness) {
    splats.thickness.assign(pixels, 0.0F);
    if (!cloud.values.empty()) splats.value.assign(pixels, 0.0F);
  }
  Splatter splatter{view, splats};
  for (std::size_t i = 0; i < cloud.count(); ++i) {
    const Vec3 position = Eigen::Map<const Eigen::Vector3f>(cloud.positions.data() + 3 * i).cast<double>();
    const double radius = cloud.radii.empty() ? cloud.radius_m : static_cast<double>(cloud.radii[i]);
    if (!position.allFinite() || !(radius > 0.0) || !std::isfinite(radius)) {
      ++splats.counts.not_finite;
      continue;
    }
    const Sphere sphere{view.toView(position), radius * settings.radius_factor};
    if (!(sphere.center.z() > sphere.radius)) {
      ++splats.counts.outside;
      continue;
    }
    splatter.draw(sphere, static_cast<std::uint32_t>(i), cloud.values.empty() ? 0.0F : cloud.values[i]);
  }
  splatter.divideValues();
  return splats;
}

}  // namespace bleedsim::picture
