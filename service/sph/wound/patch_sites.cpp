#include "service/sph/wound/patch_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/site_grid.h"
#include "service/sph/wound/text.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::sph {
namespace {

/// Where a row of the lattice runs: sites stand at center + i x along + j x across.
struct LatticeFrame {
  Vec2 center = Vec2::Zero();
  Vec2 along{1.0, 0.0};
  Vec2 across{0.0, 1.0};
};

struct Interval {
  double from = 0.0, to = 0.0;
};

/// The parts of a row at height t that are inside the outline, in the lattice's frame, in order.
class RowClipper {
 public:
  RowClipper(const PatchShape& shape, const LatticeFrame& frame) {
    if (const auto* polygon = std::get_if<PolygonPatch>(&shape)) {
      for (const Vec2& point : polygon->points) {
        const Vec2 offset = point - frame.center;
        points_.emplace_back(offset.dot(frame.along), offset.dot(frame.across));
        height_ = std::max(height_, std::abs(points_.back().y()));
      }
      return;
    }
    const auto* disc = std::get_if<DiscPatch>(&shape);
    const auto* ellipse = std::get_if<EllipsePatch>(&shape);
    width_ = disc != nullptr ? disc->radius : ellipse->semi_axis_u;
    height_ = disc != nullptr ? disc->radius : ellipse->semi_axis_v;
  }

  double height() const { return height_; }

  void clip(double t, std::vector<Interval>& inside) const {
    inside.clear();
    if (points_.empty()) {
      const double ratio = t / height_;
      if (std::abs(ratio) > 1.0) return;
      const double half = width_ * std::sqrt(1.0 - ratio * ratio);
      inside.push_back({-half, half});
      return;
    }
    std::array<double, kMaxPatchPoints> crossings{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec2& a = points_[i];
      const Vec2& b = points_[(i + 1) % points_.size()];
      if ((a.y() <= t) == (b.y() <= t)) continue;
      crossings[count++] = a.x() + (t - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    }
    std::sort(crossings.begin(), crossings.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i + 1 < count; i += 2) inside.push_back({crossings[i], crossings[i + 1]});
  }

 private:
  std::vector<Vec2> points_;  // of a polygon, in the lattice's frame
  double width_ = 0.0;        // semi-axes of the other shapes
  double height_ = 0.0;
};

/// Appends the lattice's sites inside, at most one more than allowed.
void clipLattice(const RowClipper& clipper, double spacing, const Vec2& offset, std::vector<Vec2>& sites) {
  std::vector<Interval> inside;
  const double slack = 1e-9;  // of a spacing: sites that rounding would push off an exact edge stay
  const double rows = clipper.height() / spacing;
  for (double j = std::ceil(-rows - offset.y() - slack); j <= rows - offset.y() + slack; j += 1.0) {
    const double t = std::clamp((j + offset.y()) * spacing, -clipper.height(), clipper.height());
    clipper.clip(t, inside);
    for (const Interval& part : inside) {
      const double last = std::floor(part.to / spacing - offset.x() + slack);
      for (double i = std::ceil(part.from / spacing - offset.x() - slack); i <= last; i += 1.0) {
        if (sites.size() > kMaxPatchSites) return;
        sites.emplace_back((i + offset.x()) * spacing, (j + offset.y()) * spacing);
      }
    }
  }
}

/// Centroid and principal axes of a polygon by the moments of its triangle fan.
LatticeFrame principalFrame(const PolygonPatch& polygon) {
  const Vec2 base = polygon.points[0];
  double twice_area = 0.0;
  Vec2 first = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.points.size(); ++i) {
    const Vec2 a = polygon.points[i] - base;
    const Vec2 b = polygon.points[i + 1] - base;
    const double weight = a.x() * b.y() - a.y() * b.x();
    const Vec2 sum = a + b;
    twice_area += weight;
    first += weight / 3.0 * sum;
    second += weight / 12.0 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
  }
  const Vec2 centroid = first / twice_area;
  const Eigen::Matrix2d moments = second / twice_area - centroid * centroid.transpose();
  LatticeFrame frame;
  frame.center = base + centroid;
  const double spread = moments(0, 0) - moments(1, 1);
  // A square has no principal axis: below a thousandth of difference rounding would choose one, so u stays.
  if (std::hypot(spread, 2.0 * moments(0, 1)) > 1e-3 * moments.trace()) {
    const double angle = 0.5 * std::atan2(2.0 * moments(0, 1), spread);
    frame.along = {std::cos(angle), std::sin(angle)};
    frame.across = {-frame.along.y(), frame.along.x()};
  }
  return frame;
}

std::vector<Vec2> latticeSites(const PatchShape& shape, double spacing, double wanted) {
  LatticeFrame frame;
  if (const auto* polygon = std::get_if<PolygonPatch>(&shape)) frame = principalFrame(*polygon);
  const RowClipper clipper{shape, frame};
  constexpr std::array<std::array<double, 2>, 4> kOffsets{{{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}, {0.5, 0.5}}};
  std::vector<Vec2> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const auto& offset : kOffsets) {
    std::vector<Vec2> sites;
    clipLattice(clipper, spacing, {offset[0], offset[1]}, sites);
    if (sites.empty()) continue;
    const double excess = static_cast<double>(sites.size()) - wanted;
    const bool makes_up_area = excess >= -1e-9 * wanted && excess <= (kDenseGap - 1.0) * wanted;
    const double cost = makes_up_area ? excess : wanted + std::abs(excess);
    if (cost < best_cost) {
      best_cost = cost;
      best = std::move(sites);
    }
  }
  if (best.empty()) {
    // A small or thin outline between the lattice's lines: the middle of its widest part on the line through the centre.
    std::vector<Interval> inside;
    clipper.clip(0.0, inside);
    const auto widest = std::max_element(inside.begin(), inside.end(),
                                         [](const Interval& a, const Interval& b) { return a.to - a.from < b.to - b.from; });
    best.emplace_back(widest == inside.end() ? 0.0 : 0.5 * (widest->from + widest->to), 0.0);
  }
  for (Vec2& site : best) site = frame.center + site.x() * frame.along + site.y() * frame.across;
  return best;
}

/// Walks every row in steps of a sixteenth of the spacing and keeps the points that are far enough from all kept before.
std::vector<Vec2> polylineSites(const PolylinePatch& line, double spacing, double extent) {
  SiteGrid grid{extent + spacing, spacing};
  const double separation = kSiteSeparation * spacing;
  const double length = polylineLength(line);
  const double width = line.width / spacing;
  const double up = std::ceil(width - 1e-9);
  const double rows = up <= kDenseGap * width ? up : std::max(1.0, up - 1.0);
  for (double row = 0.0; row < rows; row += 1.0) {
    const double offset = (row - 0.5 * (rows - 1.0)) * spacing;
    const double cap = std::sqrt(std::max(0.0, 0.25 * line.width * line.width - offset * offset));
    const double row_length = length + 2.0 * cap;
    const double stations = std::max(1.0, std::floor(row_length / spacing + 1e-9));
    const double lead = 0.5 * (row_length - (stations - 1.0) * spacing) - cap;
    double start = 0.0;  // arc length of the segment's first point
    double step = 0.0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vec2 edge = line.points[i + 1] - line.points[i];
      const double edge_length = edge.norm();
      const Vec2 along = edge / edge_length;
      const Vec2 across{-along.y(), along.x()};
      for (;; step += 1.0) {
        const double s = lead + step * spacing / 16.0;
        if (s > start + edge_length * (1.0 + 1e-12) + (i + 2 == line.points.size() ? cap : 0.0)) break;
        const Vec2 candidate = line.points[i] + (s - start) * along + offset * across;
        bool free = true;
        grid.forEachNear(candidate, [&](std::uint32_t, double squared) { free = free && squared >= separation * separation; });
        if (free) grid.insert(candidate);
        if (grid.sites().size() > kMaxPatchSites) return grid.sites();
      }
      start += edge_length;
    }
  }
  return grid.sites();
}

}  // namespace

Result<PatchSites> makePatchSites(const PatchShape& shape, double spacing) {
  if (Status status = checkPatch(shape); !status) return status;
  PatchSites result;
  result.area = patchArea(shape);
  const double extent = boundingRadius(shape);
  const double wanted = result.area / (spacing * spacing);
  if (extent > kMaxPatchSpacings * spacing) {
    return Status{StatusCode::capacity, textOf("patch reaches ", extent, " m from its origin; at a spacing of ", spacing,
                                               " m at most ", kMaxPatchSpacings * spacing, " m are possible")};
  }
  const auto too_many = [&] {
    return Status{StatusCode::capacity,
                  textOf("patch area ", result.area, " m^2 needs more than ", kMaxPatchSites, " emission sites at a spacing of ",
                         spacing, " m; make it smaller, or the spacing larger")};
  };
  if (wanted > static_cast<double>(kMaxPatchSites)) return too_many();
  const auto* line = std::get_if<PolylinePatch>(&shape);
  if (line != nullptr && polylineLength(*line) > static_cast<double>(kMaxPatchSites) * spacing) return too_many();
  result.sites = line != nullptr ? polylineSites(*line, spacing, extent) : latticeSites(shape, spacing, wanted);
  if (result.sites.size() > kMaxPatchSites) return too_many();
  result.gap = spacing * std::max(1.0, static_cast<double>(result.sites.size()) / wanted);
  return result;
}

}  // namespace bleedsim::sph
