#include "service/picture/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bleedsim::picture {
namespace {

struct ViewRow {
  NamedView view;
  std::string_view name;
  std::array<double, 3> direction;
};

constexpr std::array<ViewRow, 4> kViews{{
    {NamedView::front, "front", {0.0, 1.0, 0.0}},
    {NamedView::side, "side", {-1.0, 0.0, 0.0}},
    {NamedView::top, "top", {0.0, 0.0, -1.0}},
    {NamedView::oblique, "oblique", {-0.35, 1.0, -0.7}},
}};

const ViewRow& rowOf(NamedView view) {
  return *std::find_if(kViews.begin(), kViews.end(), [view](const ViewRow& row) { return row.view == view; });
}

Status invalid(const std::string& message) { return {StatusCode::invalid_argument, message}; }

// Below this sine of the angle between up and the line of sight the roll of the camera is a matter of rounding.
constexpr double kLeastSine = 1e-6;
constexpr double kWidestField = 170.0;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

bool isField(double degrees) { return degrees > 0.0 && degrees <= kWidestField; }

/// Rows: right, up, forward. `forward` and `up` are not parallel.
Eigen::Matrix3d axesOf(const Vec3& forward, const Vec3& up) {
  Eigen::Matrix3d axes;
  axes.row(2) = forward.normalized();
  axes.row(0) = forward.cross(up).normalized();
  axes.row(1) = Vec3{axes.row(0)}.cross(Vec3{axes.row(2)});
  return axes;
}

}  // namespace

std::optional<Bounds> boundsOf(std::span<const float> positions, double margin_m) {
  std::optional<Bounds> bounds;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const Vec3 p{static_cast<double>(positions[i]), static_cast<double>(positions[i + 1]), static_cast<double>(positions[i + 2])};
    if (!p.allFinite()) continue;
    if (!bounds) bounds = Bounds{p, p};
    bounds->lower = bounds->lower.cwiseMin(p);
    bounds->upper = bounds->upper.cwiseMax(p);
  }
  if (bounds) {
    bounds->lower.array() -= margin_m;
    bounds->upper.array() += margin_m;
  }
  return bounds;
}

Result<NamedView> parseView(std::string_view name) {
  std::string names;
  for (const ViewRow& row : kViews) {
    if (row.name == name) return row.view;
    names += (names.empty() ? "" : ", ") + std::string{row.name};
  }
  return invalid("there is no view '" + std::string{name} + "': choose one of " + names);
}

std::string_view nameOf(NamedView view) { return rowOf(view).name; }

Vec3 directionOf(NamedView view) {
  const auto& d = rowOf(view).direction;
  return Vec3{d[0], d[1], d[2]}.normalized();
}

Result<Camera> fitCamera(const Bounds& bounds, const Vec3& direction, const FitOptions& options) {
  if (!bounds.lower.allFinite() || !bounds.upper.allFinite() || (bounds.lower.array() > bounds.upper.array()).any()) {
    return invalid("the box to show is empty or not finite: give a lower corner that is below the upper one");
  }
  if (!direction.allFinite() || direction.norm() < 1e-12)
    return invalid("the direction of the camera has no length: give another");
  if (!(options.aspect > 0.0) || !std::isfinite(options.aspect)) return invalid("the aspect of the picture must be above 0");
  if (!(options.margin >= 0.0 && options.margin <= 0.45)) return invalid("the margin must be from 0 to 0.45 of the picture");
  if (!isField(options.field_of_view_deg)) return invalid("the field of view must be above 0 and at most 170 degrees");

  Camera camera;
  camera.projection = options.projection;
  camera.field_of_view_deg = options.field_of_view_deg;
  camera.target = 0.5 * (bounds.lower + bounds.upper);
  const Vec3 forward = direction.normalized();
  if (forward.cross(Vec3::UnitZ()).norm() < 1e-3) camera.up = Vec3::UnitY();
  const Eigen::Matrix3d axes = axesOf(forward, camera.up);
  const double half_diagonal = std::max(0.5 * (bounds.upper - bounds.lower).norm(), 1e-9);

  const double used = 1.0 - 2.0 * options.margin;
  const double tangent_x = std::tan(0.5 * radians(options.field_of_view_deg)) * used;
  const double tangent_y = tangent_x / options.aspect;
  double distance = 0.0;
  double half_width = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 world{(corner & 1) != 0 ? bounds.upper.x() : bounds.lower.x(),
                     (corner & 2) != 0 ? bounds.upper.y() : bounds.lower.y(),
                     (corner & 4) != 0 ? bounds.upper.z() : bounds.lower.z()};
    const Vec3 p = axes * (world - camera.target);
    half_width = std::max({half_width, std::abs(p.x()), std::abs(p.y()) * options.aspect});
    distance = std::max({distance, std::abs(p.x()) / tangent_x - p.z(), std::abs(p.y()) / tangent_y - p.z()});
  }
  camera.width_m = 2.0 * std::max(half_width, 1e-9) / used;
  if (options.projection == Camera::Projection::orthographic) distance = 0.0;
  // Also a flat box seen from its side must lie in front of the eye.
  camera.eye = camera.target - std::max(distance, 2.0 * half_diagonal) * forward;
  return camera;
}

Result<Camera> fitCamera(const Bounds& bounds, NamedView view, const FitOptions& options) {
  return fitCamera(bounds, directionOf(view), options);
}

Result<View> View::create(const Camera& camera, int width, int height) {
  if (width < 1 || height < 1) return invalid("a picture needs at least 1 x 1 pixels");
  if (!camera.eye.allFinite() || !camera.target.allFinite() || !camera.up.allFinite()) {
    return invalid("the camera's eye, target and up must be finite numbers");
  }
  const Vec3 forward = camera.target - camera.eye;
  if (!(forward.norm() > 1e-12)) return invalid("the camera's eye and target are the same point: move one of them");
  if (!(camera.up.norm() > 0.0) || forward.normalized().cross(camera.up.normalized()).norm() < kLeastSine) {
    return invalid("the camera's up runs along its line of sight: choose another up, e.g. 0 1 0");
  }
  View view;
  view.perspective_ = camera.projection == Camera::Projection::perspective;
  if (view.perspective_) {
    if (!isField(camera.field_of_view_deg)) return invalid("the field of view must be above 0 and at most 170 degrees");
    view.scale_ = 0.5 * width / std::tan(0.5 * radians(camera.field_of_view_deg));
  } else {
    if (!(camera.width_m > 0.0) || !std::isfinite(camera.width_m)) return invalid("the camera's width must be above 0 m");
    view.scale_ = width / camera.width_m;
  }
  view.width_ = width;
  view.height_ = height;
  view.eye_ = camera.eye;
  view.target_depth_ = forward.norm();
  view.axes_ = axesOf(forward, camera.up);
  return view;
}

Eigen::Vector2d View::toPixel(const Vec3& view) const {
  const double scale = pixelsPerMetre(view.z());
  return {0.5 * width_ + scale * view.x(), 0.5 * height_ - scale * view.y()};
}

Vec3 View::fromPixel(double x, double y, double depth) const {
  const double scale = pixelsPerMetre(depth);
  return {(x - 0.5 * width_) / scale, (0.5 * height_ - y) / scale, depth};
}

Ray View::rayThrough(double x, double y) const {
  const Eigen::Matrix3d to_world = axes_.transpose();
  if (!perspective_) return {eye_ + to_world * fromPixel(x, y, 0.0), to_world.col(2)};
  return {eye_, to_world * fromPixel(x, y, 1.0)};
}

}  // namespace bleedsim::picture
