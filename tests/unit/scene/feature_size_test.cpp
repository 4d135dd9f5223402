#include "service/scene/feature_size.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace bleedsim::scene {
namespace {

using sph::Vec2;

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<Vec2> turned(std::vector<Vec2> points, double angle) {
  const Vec2 along{std::cos(angle), std::sin(angle)};
  for (Vec2& p : points) p = {along.x() * p.x() - along.y() * p.y(), along.y() * p.x() + along.x() * p.y()};
  return points;
}

/// 20 mm by 0.8 mm.
const std::vector<Vec2> kSlit{{-0.01, -0.0004}, {0.01, -0.0004}, {0.01, 0.0004}, {-0.01, 0.0004}};

TEST(PatchWidth, OfEachShape) {
  EXPECT_EQ(patchWidth(sph::DiscPatch{0.002}), 0.004);
  EXPECT_EQ(patchWidth(sph::EllipsePatch{0.01, 0.002}), 0.004);
  EXPECT_EQ(patchWidth(sph::PolylinePatch{{{0.0, 0.0}, {0.02, 0.02}}, 0.0008}), 0.0008);
  EXPECT_NEAR(patchWidth(sph::PolygonPatch{turned(kSlit, 0.7)}), 0.0008, 1e-12);
}

double widthOf(const std::vector<Vec2>& points) { return patchWidth(sph::PolygonPatch{points}); }

/// Every `width` below is right to a thousandth: the search for the widest circle stops there.
void expectWidth(const std::vector<Vec2>& points, double width) {
  constexpr double kTolerance = 1.001e-3;
  EXPECT_NEAR(widthOf(points), width, kTolerance * width);
  EXPECT_NEAR(widthOf({points.rbegin(), points.rend()}), width, kTolerance * width) << "clockwise";
  for (const double angle : {0.3, 1.9, 4.0}) EXPECT_NEAR(widthOf(turned(points, angle)), width, kTolerance * width) << angle;
}

std::vector<Vec2> ellipse(int corners, double a, double b, double phase = 0.0) {
  std::vector<Vec2> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + phase) / corners;
    points.emplace_back(a * std::cos(angle), b * std::sin(angle));
  }
  return points;
}

TEST(PatchWidth, OfASlitDoesNotDependOnItsDirection) {
  for (int k = 0; k < 24; ++k) { EXPECT_NEAR(widthOf(turned(kSlit, k * std::numbers::pi / 24.0)), 0.0008, 1e-12) << k; }
  expectWidth({{-0.1, -5e-6}, {0.1, -5e-6}, {0.1, 5e-6}, {-0.1, 5e-6}}, 1e-5);
}

// The inradius of n corners on a circle of radius 1 is cos(pi/n).
TEST(PatchWidth, OfARegularPolygonIsTwiceItsInradius) {
  for (const int corners : {3, 5, 6, 12, 63, 64}) {
    SCOPED_TRACE(corners);
    expectWidth(ellipse(corners, 1.0, 1.0), 2.0 * std::cos(std::numbers::pi / corners));
  }
}

// A tip is no neck. Sides 3, 4, 5 have inradius 1; a wedge of 0.02 rad, 1 long, has area/half circumference.
TEST(PatchWidth, OfATriangleIsTwiceItsInradius) {
  expectWidth({{0.0, 0.0}, {3.0, 0.0}, {0.0, 4.0}}, 2.0);
  const double half_base = std::tan(0.01);
  expectWidth({{0.0, 0.0}, {1.0, -half_base}, {1.0, half_base}}, 2.0 * half_base / (half_base + 1.0 / std::cos(0.01)));
}

// With corners at the ends of the small axis the polygon is as wide as the ellipse but for cos(pi/n): the polygon is the regular
// one, stretched, and what is stretched along its long axis does not become narrower.
TEST(PatchWidth, OfAnEllipsesCornersIsNearlyItsSmallAxis) {
  for (const double ratio : {1.0, 1.5, 2.0, 5.0, 10.0, 20.0, 100.0}) {
    for (const int corners : {16, 17, 32, 64, 128}) {
      for (const double phase : {0.0, 0.5, 0.3}) {
        SCOPED_TRACE(testing::Message() << ratio << " " << corners << " " << phase);
        const double smooth = patchWidth(sph::EllipsePatch{0.001 * ratio, 0.001});
        for (const double angle : {0.0, 0.7}) {
          const double width = widthOf(turned(ellipse(corners, 0.001 * ratio, 0.001, phase), angle));
          EXPECT_LE(width, smooth * (1.0 + 1e-12));
          EXPECT_GE(width, smooth * std::cos(std::numbers::pi / corners) * (1.0 - 1e-3));
        }
      }
    }
  }
}

TEST(PatchWidth, OfAnHourglassIsItsNeck) {
  expectWidth({{-1.0, -1.0}, {1.0, -1.0}, {0.1, 0.0}, {1.0, 1.0}, {-1.0, 1.0}, {-0.1, 0.0}}, 0.2);
  // The same with a neck that two arcs of radius 1 leave open, and with one side straight.
  for (const int corners : {9, 10, 31}) {
    std::vector<Vec2> round{{2.0, 1.5}, {-2.0, 1.5}};
    std::vector<Vec2> half{{2.0, 1.5}, {0.0, 1.5}, {0.0, -1.5}, {2.0, -1.5}};
    const auto corner = [corners](int k) {
      const double angle = std::numbers::pi * k / (corners - 1);
      return Vec2{1.1 - std::sin(angle), std::cos(angle)};
    };
    double nearest = kFar;
    for (int k = 0; k < corners; ++k) {
      round.push_back({-corner(k).x(), corner(k).y()});
      half.push_back(corner(corners - 1 - k));
      nearest = std::min(nearest, corner(k).x());
    }
    round.insert(round.end(), {{-2.0, -1.5}, {2.0, -1.5}});
    for (int k = corners; k-- > 0;) round.push_back(corner(k));
    SCOPED_TRACE(corners);
    expectWidth(round, 2.0 * nearest);
    expectWidth(half, nearest);
  }
}

// Two legs of 20 mm, 1 mm wide.
TEST(PatchWidth, OfABentSlitIsThatOfItsLegs) {
  const std::vector<Vec2> bent{{0.0, 0.0}, {0.02, 0.0}, {0.02, 0.001}, {0.001, 0.001}, {0.001, 0.02}, {0.0, 0.02}};
  expectWidth(bent, 0.001);
  std::vector<Vec2> rounded = turned(bent, 0.4);
  for (Vec2& p : rounded) p = {std::round(p.x() * 1e6) * 1e-6, std::round(p.y() * 1e6) * 1e-6};
  EXPECT_NEAR(widthOf(rounded), 0.001, 2e-6) << "coordinates in whole micrometres";
}

// A limb of 20 on a square of 10, which narrows to its end: its beginning counts. At 0.2 rad on each side it is a
// part of the whole, whose widest circle counts.
TEST(PatchWidth, OfALimbIsThatOfItsBeginning) {
  const auto with_limb = [](double half, double half_end) {
    return std::vector<Vec2>{{-5, -5}, {5, -5}, {5, -half}, {25, -half_end}, {25, half_end}, {5, half}, {5, 5}, {-5, 5}};
  };
  expectWidth(with_limb(0.5, 0.5), 1.0);
  expectWidth(with_limb(0.5, 0.4), 1.0);
  expectWidth(with_limb(0.5, 1e-4), 1.0);
  expectWidth(with_limb(2.0, 1e-4), 4.0);
  expectWidth(with_limb(4.2, 0.1), 10.0);
}

// A bow, 1 mm wide along a quarter of a circle of 10 mm, and a crescent, which is 1 mm wide in its middle only.
TEST(PatchWidth, OfABowAndOfACrescent) {
  constexpr int kCorners = 25;
  std::vector<Vec2> bow;
  std::vector<Vec2> crescent;
  const auto at = [](double radius, double share) {
    const double angle = 0.5 * std::numbers::pi * share;
    return Vec2{radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (int k = 0; k < kCorners; ++k) {
    const double share = static_cast<double>(k) / (kCorners - 1);
    bow.push_back(at(0.0105, share));
    crescent.push_back(at(0.010 + 0.001 * std::sin(std::numbers::pi * share), share));
  }
  for (int k = kCorners; k-- > 0;) {
    const double share = static_cast<double>(k) / (kCorners - 1);
    bow.push_back(at(0.0095, share));
    if (k > 0 && k < kCorners - 1) crescent.push_back(at(0.010, share));
  }
  // Corners stand on the arcs, so the bow is the 1 mm between them times the cosine of half a corner's angle wide.
  EXPECT_NEAR(widthOf(bow), 0.001 * std::cos(0.25 * std::numbers::pi / (kCorners - 1)), 1e-8);
  EXPECT_NEAR(widthOf(crescent), 0.001, 2e-5);
}

// The gap between the arms of a U is tissue, not wound.
TEST(PatchWidth, DoesNotMeasureOutside) {
  expectWidth({{0.0, 0.0}, {0.021, 0.0}, {0.021, 0.02}, {0.011, 0.02}, {0.011, 0.01}, {0.01, 0.01}, {0.01, 0.02}, {0.0, 0.02}},
              0.01);
}

/// Distance to the outline, m; negative outside, by the winding of the corners around the point.
double depthOf(const std::vector<Vec2>& points, const Vec2& point) {
  double least = kFar;
  double winding = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i] - point;
    const Vec2 b = points[(i + 1) % points.size()] - point;
    const Vec2 along = b - a;
    least = std::min(least, (a + std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm());
    winding += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(winding) > 1.0 ? least : -least;
}

/// Inside places on a lattice.
class Places {
 public:
  Places(const std::vector<Vec2>& points, double extent, double step)
      : step_{step}, side_{static_cast<int>(2.0 * extent / step)} {
    for (int k = 0; k < side_ * side_; ++k) { depths_.push_back(depthOf(points, placeAt(k % side_, k / side_, step, extent))); }
  }

  static Vec2 placeAt(int column, int row, double step, double extent) {
    return {(column + 0.5) * step - extent, (row + 0.5) * step - extent};
  }
  double deepest() const { return *std::max_element(depths_.begin(), depths_.end()); }

  /// Connected parts of the places deeper than `depth`, but for those that the lattice alone may have parted from others: whose
  /// deepest place is not deeper by three steps.
  int partsBeyond(double depth) const {
    std::vector<bool> left(depths_.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = depths_[k] > depth;
    int parts = 0;
    std::vector<int> flooded;
    for (int k = 0; k < side_ * side_; ++k) {
      if (!left[static_cast<std::size_t>(k)]) continue;
      double deepest = 0.0;
      for (flooded.push_back(k); !flooded.empty();) {
        const int place = flooded.back();
        flooded.pop_back();
        deepest = std::max(deepest, depths_[static_cast<std::size_t>(place)]);
        for (const int row : {-side_, 0, side_}) {
          for (const int other : {place + row - 1, place + row, place + row + 1}) {
            if (other < 0 || other >= side_ * side_ || !left[static_cast<std::size_t>(other)]) continue;
            left[static_cast<std::size_t>(other)] = false;
            flooded.push_back(other);
          }
        }
      }
      if (deepest > depth + 3.0 * step_) ++parts;
    }
    return parts;
  }

 private:
  double step_;
  int side_;
  std::vector<double> depths_;
};

// A disc that is a tenth smaller than the narrowest place passes between all places where it has room to spare. One that is a
// twentieth larger finds no room, or cannot pass between two places: unless there is little more room behind the neck than in it.
TEST(PatchWidth, OfStarsLetsADiscPass) {
  std::mt19937 random{7};
  int open = 0;
  int with_neck = 0;
  for (int star = 0; star < 32; ++star) {
    const int corners = 5 + star / 2;
    std::vector<Vec2> points;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      const double length = 0.5 + 2.5 * static_cast<double>(random()) / 0x1p32;
      points.emplace_back(length * std::cos(angle), length * std::sin(angle));
    }
    SCOPED_TRACE(star);
    const double width = widthOf(points);
    expectWidth(points, width);
    const Places places{points, 3.0, 0.01 * width};
    EXPECT_EQ(places.partsBeyond(0.45 * width), 1);
    EXPECT_LE(width, 2.0 * (places.deepest() + 0.01 * width));
    const int parts = places.partsBeyond(0.525 * width);
    if (parts == 0) ++open;
    if (parts > 1) ++with_neck;
  }
  EXPECT_GT(with_neck, 5);
  EXPECT_GT(open, 5);
}

}  // namespace
}  // namespace bleedsim::scene
