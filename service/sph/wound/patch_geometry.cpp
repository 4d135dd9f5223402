#include "service/sph/wound/patch_geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/sph/wound/text.h"

namespace bleedsim::sph {
namespace {

struct Area {
  double operator()(const DiscPatch& disc) const { return std::numbers::pi * disc.radius * disc.radius; }
  double operator()(const EllipsePatch& ellipse) const { return std::numbers::pi * ellipse.semi_axis_u * ellipse.semi_axis_v; }
  double operator()(const PolygonPatch& polygon) const {
    // The shoelace sum about the first point, so that a polygon far from the origin loses no digits.
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.points.size(); ++i) {
      const Vec2 a = polygon.points[i] - polygon.points[0];
      const Vec2 b = polygon.points[i + 1] - polygon.points[0];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(twice);
  }
  double operator()(const PolylinePatch& line) const {
    return polylineLength(line) * line.width + 0.25 * std::numbers::pi * line.width * line.width;
  }
};

double furthestPoint(const std::vector<Vec2>& points) {
  double furthest = 0.0;
  for (const Vec2& point : points) furthest = std::max(furthest, point.norm());
  return furthest;
}

struct Bound {
  double operator()(const DiscPatch& disc) const { return disc.radius; }
  double operator()(const EllipsePatch& ellipse) const { return std::max(ellipse.semi_axis_u, ellipse.semi_axis_v); }
  double operator()(const PolygonPatch& polygon) const { return furthestPoint(polygon.points); }
  double operator()(const PolylinePatch& line) const { return furthestPoint(line.points) + 0.5 * line.width; }
};

}  // namespace

double patchArea(const PatchShape& shape) { return std::visit(Area{}, shape); }

double boundingRadius(const PatchShape& shape) { return std::visit(Bound{}, shape); }

double polylineLength(const PolylinePatch& shape) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < shape.points.size(); ++i) length += (shape.points[i + 1] - shape.points[i]).norm();
  return length;
}

Result<PatchFrame> makePatchFrame(const Vec3& origin, const Vec3& normal, const Vec3& tangent) {
  const auto bad = [](const char* what, const Vec3& value, const char* remedy) {
    return Status{StatusCode::invalid_argument, textOf("wound ", what, " ", textOfPoint(value), " ", remedy)};
  };
  if (!origin.allFinite()) return bad("position", origin, "must be finite");
  if (!normal.allFinite()) return bad("normal", normal, "must be finite");
  if (!tangent.allFinite()) return bad("tangent", tangent, "must be finite; leave it (0, 0, 0) to have one chosen");
  const double scale = normal.cwiseAbs().maxCoeff();
  if (!(scale > 1e-12)) return bad("normal", normal, "has no direction; give a vector longer than 1e-12, out of the tissue");

  PatchFrame frame;
  frame.origin = origin;
  frame.normal = (normal / scale).normalized();  // scaled first, or huge components overflow the square
  const auto in_plane = [&](const Vec3& vector) -> Vec3 { return vector - vector.dot(frame.normal) * frame.normal; };
  Vec3 u = Vec3::Zero();
  if (const double longest = tangent.cwiseAbs().maxCoeff(); longest > 0.0) u = in_plane(tangent / longest);
  if (u.norm() < 1e-6) {
    Eigen::Index axis = 0;
    frame.normal.cwiseAbs().minCoeff(&axis);
    u = in_plane(Vec3::Unit(axis));
  }
  frame.u = in_plane(u.normalized()).normalized();
  frame.v = frame.normal.cross(frame.u);
  return frame;
}

}  // namespace bleedsim::sph
