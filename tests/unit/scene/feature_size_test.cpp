#include "service/scene/feature_size.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace bleedsim::scene {
namespace {

using sph::Vec2;

std::vector<Vec2> turned(std::vector<Vec2> points, double angle) {
  const Vec2 along{std::cos(angle), std::sin(angle)};
  for (Vec2& p : points) p = {along.x() * p.x() - along.y() * p.y(), along.y() * p.x() + along.x() * p.y()};
  return points;
}

/// 20 mm by 0.8 mm.
const std::vector<Vec2> kSlit{{-0.01, -0.0004}, {0.01, -0.0004}, {0.01, 0.0004}, {-0.01, 0.0004}};

TEST(LeastWidth, DoesNotDependOnTheDirection) {
  for (int k = 0; k < 24; ++k) { EXPECT_NEAR(leastWidth(turned(kSlit, k * std::numbers::pi / 24.0)), 0.0008, 1e-12) << k; }
}

TEST(LeastWidth, IsTheSmallestHeightOfATriangle) {
  // Sides 3, 4, 5: the height on the longest is 2.4.
  EXPECT_NEAR(leastWidth({{0.0, 0.0}, {3.0, 0.0}, {0.0, 4.0}}), 2.4, 1e-12);
}

TEST(LeastWidth, OfDegenerateOutlines) {
  EXPECT_EQ(leastWidth({}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(leastWidth({{1.0, 1.0}}), 0.0);
  EXPECT_EQ(leastWidth({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}), 0.0);
}

TEST(PatchWidth, OfEachShape) {
  EXPECT_EQ(patchWidth(sph::DiscPatch{0.002}), 0.004);
  EXPECT_EQ(patchWidth(sph::EllipsePatch{0.01, 0.002}), 0.004);
  EXPECT_EQ(patchWidth(sph::PolylinePatch{{{0.0, 0.0}, {0.02, 0.02}}, 0.0008}), 0.0008);
  EXPECT_NEAR(patchWidth(sph::PolygonPatch{turned(kSlit, 0.7)}), 0.0008, 1e-12);
}

// Two legs of 20 mm, 1 mm wide: the hull is 14 mm wide, the slit is not.
TEST(PatchWidth, OfABentSlitIsThatOfItsLegs) {
  const std::vector<Vec2> bent{{0.0, 0.0}, {0.02, 0.0}, {0.02, 0.001}, {0.001, 0.001}, {0.001, 0.02}, {0.0, 0.02}};
  EXPECT_GT(leastWidth(bent), 0.013);
  EXPECT_NEAR(patchWidth(sph::PolygonPatch{bent}), 0.001, 1e-12);
  EXPECT_NEAR(patchWidth(sph::PolygonPatch{{bent.rbegin(), bent.rend()}}), 0.001, 1e-12) << "clockwise";
}

// The gap between the arms of a U is tissue, not wound.
TEST(PatchWidth, DoesNotMeasureOutside) {
  const std::vector<Vec2> u{{0.0, 0.0},    {0.021, 0.0}, {0.021, 0.02}, {0.011, 0.02},
                            {0.011, 0.01}, {0.01, 0.01}, {0.01, 0.02},  {0.0, 0.02}};
  EXPECT_NEAR(patchWidth(sph::PolygonPatch{u}), 0.01, 1e-12);
}

// A polygon of many sides counts at least sqrt 3/2 of the circle's diameter: 120 degrees apart, edges face each other.
TEST(PatchWidth, OfARoundOutlineIsNearlyItsDiameter) {
  std::vector<Vec2> round;
  for (int k = 0; k < 64; ++k) round.emplace_back(std::cos(k * std::numbers::pi / 32.0), std::sin(k * std::numbers::pi / 32.0));
  const double width = patchWidth(sph::PolygonPatch{round});
  EXPECT_GE(width, 0.85 * 2.0);
  EXPECT_LE(width, 2.0);
}

}  // namespace
}  // namespace bleedsim::scene
