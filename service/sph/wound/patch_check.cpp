#include <cmath>

#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/text.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::sph {
namespace {

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }

Status checkLength(const char* name, double value) {
  if (value >= kPatchLength.lower && value <= kPatchLength.upper) return {};  // false for NaN
  return invalid(textOf("patch ", name, " is ", value, " m; allowed are ", kPatchLength.lower, " to ", kPatchLength.upper, " m"));
}

Status checkPoints(const char* shape, const std::vector<Vec2>& points, std::size_t fewest, bool closed) {
  if (points.size() < fewest || points.size() > kMaxPatchPoints) {
    return invalid(textOf(shape, " patch has ", points.size(), " points; allowed are ", fewest, " to ", kMaxPatchPoints));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i].cwiseAbs().maxCoeff() <= kPatchCoordinate.upper) || !points[i].allFinite()) {
      return invalid(textOf(shape, " patch point ", i, " is ", textOfPoint(points[i]),
                            " m; coordinates must be finite and within ", kPatchCoordinate.lower, " to ", kPatchCoordinate.upper,
                            " m"));
    }
  }
  const std::size_t pairs = closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::size_t next = (i + 1) % points.size();
    if ((points[next] - points[i]).norm() < kMinPointDistance) {
      return invalid(textOf(shape, " patch points ", i, " and ", next, " coincide at ", textOfPoint(points[i]),
                            " m; leave one out", closed ? " (the last point joins the first by itself)" : ""));
    }
  }
  return {};
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool withinBox(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (p.array() >= a.cwiseMin(b).array()).all() && (p.array() <= a.cwiseMax(b).array()).all();
}

/// Touching counts: an outline that touches itself pinches off a part.
bool segmentsMeet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double abc = turn(a, b, c);
  const double abd = turn(a, b, d);
  const double cda = turn(c, d, a);
  const double cdb = turn(c, d, b);
  if (((abc > 0.0 && abd < 0.0) || (abc < 0.0 && abd > 0.0)) && ((cda > 0.0 && cdb < 0.0) || (cda < 0.0 && cdb > 0.0))) {
    return true;
  }
  return (abc == 0.0 && withinBox(a, b, c)) || (abd == 0.0 && withinBox(a, b, d)) || (cda == 0.0 && withinBox(c, d, a)) ||
         (cdb == 0.0 && withinBox(c, d, b));
}

/// Neighbouring edges share a point; they may not also fold back onto each other.
bool foldsBack(const Vec2& a, const Vec2& b, const Vec2& c) { return turn(a, b, c) == 0.0 && (a - b).dot(c - b) > 0.0; }

Status checkSimple(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  const auto at = [&](std::size_t i) -> const Vec2& { return points[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (foldsBack(at(i), at(i + 1), at(i + 2))) {
      return invalid(textOf("polygon patch folds back onto itself at point ", (i + 1) % n, " ", textOfPoint(at(i + 1)),
                            " m; give the outline in order, without spikes"));
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segmentsMeet(at(i), at(i + 1), at(j), at(j + 1))) {
        return invalid(textOf("polygon patch crosses itself: the edge from point ", i, " meets the edge from point ", j,
                              "; give the outline's points in order, once around"));
      }
    }
  }
  return {};
}

struct Check {
  Status operator()(const DiscPatch& disc) const { return checkLength("radius", disc.radius); }
  Status operator()(const EllipsePatch& ellipse) const {
    if (Status status = checkLength("semi_axis_u", ellipse.semi_axis_u); !status) return status;
    return checkLength("semi_axis_v", ellipse.semi_axis_v);
  }
  Status operator()(const PolygonPatch& polygon) const {
    if (Status status = checkPoints("polygon", polygon.points, kMinPolygonPoints, true); !status) return status;
    if (Status status = checkSimple(polygon.points); !status) return status;
    const double area = patchArea(polygon);
    if (area >= kMinPatchArea) return {};
    return invalid(textOf("polygon patch encloses ", area, " m^2; at least ", kMinPatchArea, " m^2 are needed"));
  }
  Status operator()(const PolylinePatch& line) const {
    if (Status status = checkLength("width", line.width); !status) return status;
    return checkPoints("polyline", line.points, kMinPolylinePoints, false);
  }
};

}  // namespace

Status checkPatch(const PatchShape& shape) { return std::visit(Check{}, shape); }

}  // namespace bleedsim::sph
