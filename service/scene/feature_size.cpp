#include "service/scene/feature_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

namespace bleedsim::scene {
namespace {

using sph::Vec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A circle may reach this share of its radius beyond an outline that it touches: coordinates rounded to micrometres make the
// sides of a slit lean by up to 0.2 mrad.
constexpr double kLean = 2e-8;
// A limb may narrow towards its end, each side by up to 0.15 rad, if it begins at a place where within its width there is room
// for a circle half as wide again. Sides that lean no more make room for 1.3 of it only, as those of a wedge or of an ellipse.
constexpr double kLimbLean = 0.0112;  // 1 - cos 0.15, of the radius as kLean
constexpr double kLimbRoom = 1.5;
// Of the widest circle's radius, and how many squares the search for it looks at: a wound by command must not wait for it.
constexpr double kPrecision = 1e-3;
constexpr int kMostSquares = 4000;

struct Edge {
  Vec2 from, to;
};

std::vector<Edge> edgesOf(const std::vector<Vec2>& points) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Edge edge{points[i], points[(i + 1) % points.size()]};
    if ((edge.to - edge.from).squaredNorm() > 0.0) edges.push_back(edge);
  }
  return edges;
}

Vec2 nearestOn(const Edge& edge, const Vec2& point) {
  const Vec2 along = edge.to - edge.from;
  return edge.from + std::clamp((point - edge.from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

/// Distance to the outline, m; negative outside.
double depthAt(const std::vector<Edge>& edges, const Vec2& point) {
  double squared = kInfinity;
  bool inside = false;
  for (const Edge& edge : edges) {
    squared = std::min(squared, (point - nearestOn(edge, point)).squaredNorm());
    if ((edge.from.y() > point.y()) == (edge.to.y() > point.y())) continue;
    const double crossing =
        edge.from.x() + (point.y() - edge.from.y()) / (edge.to.y() - edge.from.y()) * (edge.to.x() - edge.from.x());
    if (point.x() < crossing) inside = !inside;
  }
  return inside ? std::sqrt(squared) : -std::sqrt(squared);
}

/// The narrowest neck: the shortest way across the inside that is the diameter of a circle inside. So the outline is normal to it
/// at both ends, and leads away from the circle or along it; but for the beginning of a limb. Infinite if there is none.
class NeckSearch {
 public:
  explicit NeckSearch(const std::vector<Edge>& edges) : edges_{edges} {}

  double run() {
    const std::size_t count = edges_.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const bool before = j == (i + count - 1) % count;
        const bool after = j == (i + 1) % count;
        if (j == i) continue;
        if (!before) take(i, edges_[i].from, j, nearestOn(edges_[j], edges_[i].from));
        if (j > i && !before && !after) takeMiddle(i, j);
      }
    }
    return width_;
  }

 private:
  void take(std::size_t i, const Vec2& a, std::size_t j, const Vec2& b) {
    const double way = (b - a).norm();
    if (!(way > 0.0 && way < width_)) return;
    const Vec2 middle = 0.5 * (a + b);
    if (!isClear(i, j, middle, 0.5 * (1.0 - kLimbLean) * way) || depthAt(edges_, middle) <= 0.0) return;
    if (isClear(i, j, middle, 0.5 * (1.0 - kLean) * way) || beginsLimb(middle, b - a)) width_ = way;
  }

  bool beginsLimb(const Vec2& middle, const Vec2& way) const {
    const Vec2 along{-way.y(), way.x()};
    for (const double ahead : {-1.0, -0.75, -0.5, 0.5, 0.75, 1.0}) {
      if (2.0 * depthAt(edges_, middle + ahead * along) >= kLimbRoom * way.norm()) return true;
    }
    return false;
  }

  /// Between edges side by side, from the middle of where they are: a slit's end may be square.
  void takeMiddle(std::size_t i, std::size_t j) {
    const Edge& a = edges_[i];
    const double length = (a.to - a.from).norm();
    const Vec2 along = (a.to - a.from) / length;
    const double from = std::clamp(along.dot(edges_[j].from - a.from), 0.0, length);
    const double to = std::clamp(along.dot(edges_[j].to - a.from), 0.0, length);
    if (from == to) return;
    const Vec2 middle = a.from + 0.5 * (from + to) * along;
    take(i, middle, j, nearestOn(edges_[j], middle));
  }

  /// Whether no edge enters the circle. Most that do are near to one of its ends.
  bool isClear(std::size_t i, std::size_t j, const Vec2& center, double radius) const {
    const std::size_t count = edges_.size();
    const double squared = radius * radius;
    for (std::size_t step = 0; step <= count / 2; ++step) {
      for (const std::size_t k : {i + step, i + count - step, j + step, j + count - step}) {
        if ((center - nearestOn(edges_[k % count], center)).squaredNorm() < squared) return false;
      }
    }
    return true;
  }

  const std::vector<Edge>& edges_;
  double width_ = kInfinity;
};

struct Square {
  Vec2 center;
  double half = 0.0;   ///< side, m
  double depth = 0.0;  ///< of the center, m

  /// No point of the square is deeper.
  double deepest() const { return depth + std::numbers::sqrt2 * half; }
  bool operator<(const Square& other) const { return deepest() < other.deepest(); }
};

/// Diameter of the widest circle inside, m, or `most` if it is not less: by dividing the squares that may hold its center, the
/// most promising first.
double widestCircle(const std::vector<Edge>& edges, double most) {
  Vec2 lower = Vec2::Constant(kInfinity);
  Vec2 upper = Vec2::Constant(-kInfinity);
  for (const Edge& edge : edges) {
    lower = lower.cwiseMin(edge.from);
    upper = upper.cwiseMax(edge.from);
  }
  double radius = 0.0;
  std::priority_queue<Square> squares;
  const auto add = [&](const Vec2& center, double half) {
    const double depth = depthAt(edges, center);
    radius = std::max(radius, depth);
    squares.push({center, half, depth});
  };
  add(0.5 * (lower + upper), 0.5 * (upper - lower).maxCoeff());
  for (int count = 1; count < kMostSquares; count += 4) {
    if (2.0 * radius >= (1.0 - kPrecision) * most) return most;
    const Square square = squares.top();
    squares.pop();
    if (square.deepest() <= (1.0 + kPrecision) * radius) break;
    const double half = 0.5 * square.half;
    for (const double u : {-half, half}) {
      for (const double v : {-half, half}) add(square.center + Vec2{u, v}, half);
    }
  }
  return 2.0 * radius;
}

double polygonWidth(const std::vector<Vec2>& points) {
  const std::vector<Edge> edges = edgesOf(points);
  return edges.empty() ? 0.0 : widestCircle(edges, NeckSearch{edges}.run());
}

struct PatchWidth {
  double operator()(const sph::DiscPatch& patch) const { return 2.0 * patch.radius; }
  double operator()(const sph::EllipsePatch& patch) const { return 2.0 * std::min(patch.semi_axis_u, patch.semi_axis_v); }
  double operator()(const sph::PolygonPatch& patch) const { return polygonWidth(patch.points); }
  double operator()(const sph::PolylinePatch& patch) const { return patch.width; }
};

}  // namespace

double patchWidth(const sph::PatchShape& shape) { return std::visit(PatchWidth{}, shape); }

double patchWidthOf(const sph::Command& command) {
  if (const auto* add = std::get_if<sph::AddWound>(&command)) return patchWidth(add->wound.shape);
  const auto* update = std::get_if<sph::UpdateWound>(&command);
  if (update != nullptr && update->shape) return patchWidth(*update->shape);
  return kInfinity;
}

}  // namespace bleedsim::scene
