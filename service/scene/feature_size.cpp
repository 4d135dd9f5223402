#include "service/scene/feature_size.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bleedsim::scene {
namespace {

using sph::Vec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Inward normals with a cosine below this face each other. Neighbouring edges of a round outline do not.
constexpr double kFacing = -0.5;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Counter-clockwise, by Andrew's monotone chain. Points on one line give two corners.
std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vec2> hull;
  const auto add = [&hull](const Vec2& point, std::size_t least) {
    while (hull.size() > least && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) hull.pop_back();
    hull.push_back(point);
  };
  for (const Vec2& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  if (hull.size() > 1) hull.pop_back();
  return hull;
}

struct Edge {
  Vec2 from, to;
  Vec2 inward;  // unit
};

std::vector<Edge> edgesOf(const std::vector<Vec2>& points) {
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) area += cross(points[i], points[(i + 1) % points.size()]);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& from = points[i];
    const Vec2& to = points[(i + 1) % points.size()];
    const Vec2 along = to - from;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const Vec2 left = Vec2{-along.y(), along.x()} / length;
    edges.push_back({from, to, area >= 0.0 ? left : Vec2{-left}});
  }
  return edges;
}

Vec2 nearestOn(const Edge& edge, const Vec2& point) {
  const Vec2 along = edge.to - edge.from;
  return edge.from + std::clamp((point - edge.from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

/// The shortest way across the inside between two edges; infinite if they do not face each other. Edges of a simple outline do
/// not cross, so one end of the shortest way is a corner.
double wayAcross(const Edge& a, const Edge& b) {
  if (a.inward.dot(b.inward) > kFacing) return kInfinity;
  double shortest = kInfinity;
  const auto take = [&](const Vec2& on_a, const Vec2& on_b) {
    const Vec2 way = on_b - on_a;
    if (way.dot(a.inward) > 0.0 && way.dot(b.inward) < 0.0) shortest = std::min(shortest, way.norm());
  };
  for (const Vec2& corner : {a.from, a.to}) take(corner, nearestOn(b, corner));
  for (const Vec2& corner : {b.from, b.to}) take(nearestOn(a, corner), corner);
  return shortest;
}

double polygonWidth(const std::vector<Vec2>& points) {
  double width = leastWidth(points);
  const std::vector<Edge> edges = edgesOf(points);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) width = std::min(width, wayAcross(edges[i], edges[j]));
  }
  return width;
}

struct PatchWidth {
  double operator()(const sph::DiscPatch& patch) const { return 2.0 * patch.radius; }
  double operator()(const sph::EllipsePatch& patch) const { return 2.0 * std::min(patch.semi_axis_u, patch.semi_axis_v); }
  double operator()(const sph::PolygonPatch& patch) const { return polygonWidth(patch.points); }
  double operator()(const sph::PolylinePatch& patch) const { return patch.width; }
};

}  // namespace

double leastWidth(const std::vector<Vec2>& points) {
  if (points.empty()) return kInfinity;
  const std::vector<Vec2> hull = convexHull(points);
  if (hull.size() < 3) return 0.0;
  double least = kInfinity;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    double width = 0.0;
    for (const Vec2& corner : hull) width = std::max(width, cross(along, corner - hull[i]));
    least = std::min(least, width);
  }
  return least;
}

double patchWidth(const sph::PatchShape& shape) { return std::visit(PatchWidth{}, shape); }

}  // namespace bleedsim::scene
