// Where a picture is taken from: cameras, named views, and the resolved view that turns metres into pixels.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim::picture {

using Vec3 = Eigen::Vector3d;

/// World coordinates in metres, right-handed, +z up.
struct Camera {
  enum class Projection { orthographic, perspective };

  Projection projection = Projection::perspective;
  Vec3 eye{0.0, -1.0, 1.0};         ///< m
  Vec3 target{0.0, 0.0, 0.0};       ///< m, in the middle of the picture
  Vec3 up{0.0, 0.0, 1.0};           ///< any length, not along the line of sight
  double width_m = 0.1;             ///< orthographic: what the picture is wide
  double field_of_view_deg = 30.0;  ///< perspective: horizontal, in (0, 170]
};

/// An axis-aligned box, m.
struct Bounds {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
};

/// The box around all finite positions (3 x count, m), `margin_m` wider on every side; nothing when none is finite.
std::optional<Bounds> boundsOf(std::span<const float> positions, double margin_m);

enum class NamedView { front, side, top, oblique };

/// invalid_argument: the message lists the names front, side, top, oblique.
Result<NamedView> parseView(std::string_view name);
std::string_view nameOf(NamedView view);
/// From the camera into the scene, unit: front looks along +y, side along -x, top along -z with +y up in the picture.
Vec3 directionOf(NamedView view);

struct FitOptions {
  Camera::Projection projection = Camera::Projection::perspective;
  double aspect = 4.0 / 3.0;        ///< width / height of the picture
  double margin = 0.05;             ///< free on every side, as a part of the picture, in [0, 0.45]
  double field_of_view_deg = 30.0;  ///< perspective only
};

/// The nearest camera that looks along `direction` (any length) and sees the whole box. Up is +z, or +y when looking along z.
/// invalid_argument: a number is not finite or out of range, the box is inside out.
Result<Camera> fitCamera(const Bounds& bounds, const Vec3& direction, const FitOptions& options = {});
Result<Camera> fitCamera(const Bounds& bounds, NamedView view, const FitOptions& options = {});

/// A ray in world coordinates: origin + depth * direction, where depth counts metres along the line of sight of the camera.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// A camera for pictures of one size. View coordinates: x right, y up, z depth from the eye along the line of sight, all in m.
class View {
 public:
  /// invalid_argument: see Camera; the sizes are pixels and at least 1.
  static Result<View> create(const Camera& camera, int width, int height);

  bool perspective() const { return perspective_; }
  int width() const { return width_; }
  int height() const { return height_; }
  double targetDepth() const { return target_depth_; }  ///< m
  /// Pixels a metre across the line of sight at this depth.
  double pixelsPerMetre(double depth) const { return perspective_ ? scale_ / depth : scale_; }

  Vec3 toView(const Vec3& world) const { return axes_ * (world - eye_); }
  Vec3 directionToView(const Vec3& world) const { return axes_ * world; }
  /// Pixels from the top left; the middle of the first pixel is (0.5, 0.5). Perspective needs z > 0.
  Eigen::Vector2d toPixel(const Vec3& view) const;
  /// In view coordinates the point at (pixel, depth).
  Vec3 fromPixel(double x, double y, double depth) const;
  /// Through the point x, y of the picture, in pixels.
  Ray rayThrough(double x, double y) const;

 private:
  View() = default;

  bool perspective_ = true;
  int width_ = 0;
  int height_ = 0;
  double scale_ = 1.0;  ///< orthographic: pixels/m; perspective: focal length in pixels
  double target_depth_ = 1.0;
  Vec3 eye_ = Vec3::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  ///< rows: right, up, forward
};

}  // namespace bleedsim::picture
