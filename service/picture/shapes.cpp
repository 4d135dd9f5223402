#include "service/picture/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace bleedsim::picture {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Status invalid(const char* message) { return {StatusCode::invalid_argument, message}; }

Status check(const PlaneShape& plane) {
  if (!plane.point.allFinite() || !plane.normal.allFinite()) return invalid("a plane's point and normal must be finite numbers");
  if (!(plane.normal.norm() > 1e-12)) return invalid("a plane's normal has no length: give its direction, e.g. 0 0 1");
  if (!(plane.half_size_m > 0.0)) return invalid("a plane's half size must be above 0 m");
  return {};
}

Status check(const BoxShape& box) {
  if (!box.lower.allFinite() || !box.upper.allFinite()) return invalid("a box's corners must be finite numbers");
  if (!(box.lower.array() < box.upper.array()).all())
    return invalid("a box's lower corner must be below its upper one on every axis");
  return {};
}

Status check(const BowlShape& bowl) {
  if (!bowl.rim_center.allFinite() || !std::isfinite(bowl.sphere_radius_m) || !std::isfinite(bowl.depth_m)) {
    return invalid("a bowl's rim centre, radius and depth must be finite numbers");
  }
  if (!(bowl.depth_m > 0.0 && bowl.depth_m <= bowl.sphere_radius_m)) {
    return invalid("a bowl's depth must be above 0 and at most the radius of its sphere");
  }
  return {};
}

/// Two unit axes in the plane; for a horizontal one x and y, so that grids follow the world.
std::pair<Vec3, Vec3> tangentsOf(const Vec3& normal) {
  if (normal.z() == 1.0) return {Vec3::UnitX(), Vec3::UnitY()};
  const Vec3 start = std::abs(normal.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = (start - normal * normal.dot(start)).normalized();
  return {u, normal.cross(u)};
}

std::optional<ShapeHit> hit(const PlaneShape& plane, const Ray& ray) {
  const Vec3 normal = plane.normal.z() == 1.0 && plane.normal.squaredNorm() == 1.0 ? plane.normal : plane.normal.normalized();
  const double slope = normal.dot(ray.direction);
  if (slope > -1e-9) return std::nullopt;
  const double depth = normal.dot(plane.point - ray.origin) / slope;
  if (!(depth > 0.0)) return std::nullopt;
  const auto [u, v] = tangentsOf(normal);
  const Vec3 at = ray.origin + depth * ray.direction;
  const Vec3 offset = at - plane.point;
  if (std::max(std::abs(u.dot(offset)), std::abs(v.dot(offset))) > plane.half_size_m) return std::nullopt;
  return ShapeHit{depth, normal, {u.dot(at), v.dot(at)}};
}

std::optional<ShapeHit> hit(const BoxShape& box, const Ray& ray) {
  double enter = -kInfinity;
  double leave = kInfinity;
  int enter_axis = 0;
  int leave_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    double low = (box.lower[axis] - ray.origin[axis]) / d;
    double high = (box.upper[axis] - ray.origin[axis]) / d;
    if (std::abs(d) < 1e-12) {
      if (ray.origin[axis] < box.lower[axis] || ray.origin[axis] > box.upper[axis]) return std::nullopt;
      low = -kInfinity, high = kInfinity;
    }
    if (low > high) std::swap(low, high);
    if (low > enter) enter = low, enter_axis = axis;
    if (high < leave) leave = high, leave_axis = axis;
  }
  if (enter >= leave) return std::nullopt;
  const int axis = box.container ? leave_axis : enter_axis;
  const double depth = box.container ? leave : enter;
  if (!(depth > 0.0)) return std::nullopt;
  if (box.container && box.open_top && axis == 2 && ray.direction.z() > 0.0) return std::nullopt;
  const Vec3 at = ray.origin + depth * ray.direction;
  // Both the front of an obstacle and the inside of a container look against the ray.
  Vec3 normal = Vec3::Zero();
  normal[axis] = ray.direction[axis] > 0.0 ? -1.0 : 1.0;
  return ShapeHit{depth, normal, {axis == 0 ? at.y() : at.x(), axis == 2 ? at.y() : at.z()}};
}

std::optional<ShapeHit> hit(const BowlShape& bowl, const Ray& ray) {
  const double rim_z = bowl.rim_center.z();
  const double rise = bowl.sphere_radius_m - bowl.depth_m;
  const double rim_radius2 = bowl.sphere_radius_m * bowl.sphere_radius_m - rise * rise;
  const bool comes_from_above = ray.origin.z() > rim_z;
  if (comes_from_above) {
    if (ray.direction.z() > -1e-9) return std::nullopt;
    const double depth = (rim_z - ray.origin.z()) / ray.direction.z();
    const Vec3 at = ray.origin + depth * ray.direction;
    if ((at - bowl.rim_center).head<2>().squaredNorm() > rim_radius2) return ShapeHit{depth, Vec3::UnitZ(), at.head<2>()};
  }
  // Through the opening, or cut open from below the rim: the far side of the sphere is the inside of the hollow.
  const Vec3 center = bowl.rim_center + Vec3{0.0, 0.0, rise};
  const Vec3 offset = ray.origin - center;
  const double a = ray.direction.squaredNorm();
  const double b = offset.dot(ray.direction);
  const double under_root = b * b - a * (offset.squaredNorm() - bowl.sphere_radius_m * bowl.sphere_radius_m);
  if (under_root < 0.0) return std::nullopt;
  const double depth = (-b + std::sqrt(under_root)) / a;
  const Vec3 at = ray.origin + depth * ray.direction;
  if (!(depth > 0.0) || at.z() > rim_z) return std::nullopt;
  return ShapeHit{depth, (center - at).normalized(), at.head<2>()};
}

// Of a horizontal line of sight; rounding of a camera's axes stays well below.
constexpr double kEdgeOn = 1e-9;

bool cutBy(const PlaneShape& plane, const Ray& ray) {
  const Vec3 normal = plane.normal.normalized();
  return std::abs(normal.dot(ray.direction)) < kEdgeOn && normal.dot(ray.origin - plane.point) < 0.0;
}

bool cutBy(const BoxShape&, const Ray&) { return false; }

bool cutBy(const BowlShape& bowl, const Ray& ray) {
  return std::abs(ray.direction.z()) < kEdgeOn && ray.origin.z() < bowl.rim_center.z();
}

}  // namespace

Status checkShape(const Shape& shape) {
  return std::visit([](const auto& s) { return check(s); }, shape);
}

std::optional<ShapeHit> hitShape(const Shape& shape, const Ray& ray) {
  return std::visit([&ray](const auto& s) { return hit(s, ray); }, shape);
}

bool cutsThrough(std::span<const Shape> shapes, const Ray& ray) {
  for (const Shape& shape : shapes) {
    if (std::visit([&ray](const auto& s) { return cutBy(s, ray); }, shape)) return true;
  }
  return false;
}

std::optional<ShapeHit> hitShapes(std::span<const Shape> shapes, const Ray& ray) {
  std::optional<ShapeHit> nearest;
  for (const Shape& shape : shapes) {
    const std::optional<ShapeHit> found = hitShape(shape, ray);
    if (found && (!nearest || found->depth < nearest->depth)) nearest = found;
  }
  return nearest;
}

}  // namespace bleedsim::picture
