#include "service/sph/tissue/signed_distance.h"

#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

struct Case {
  std::string name;
  TissueShape shape;
  bool (*in_tissue)(const Vec3&);
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

const BowlShape kBowl{.rim_center = {0.1, -0.2, 0.05}, .sphere_radius = 0.9, .depth = 0.6};
const BowlShape kHemisphere{.rim_center = {0, 0, 0}, .sphere_radius = 0.8, .depth = 0.8};
const BoxShape kBox{.lower = {-0.5, -0.6, -0.4}, .upper = {0.7, 0.5, 0.6}};

bool insideBox(const Vec3& p) { return (p.array() > kBox.lower.array()).all() && (p.array() < kBox.upper.array()).all(); }

bool behindBowl(const BowlShape& bowl, const Vec3& p) {
  const Vec3 center = bowl.rim_center + Vec3(0, 0, bowl.sphere_radius - bowl.depth);
  return p.z() < bowl.rim_center.z() && (p - center).norm() > bowl.sphere_radius;
}

BoxShape variantOf(bool obstacle, bool open_top) {
  BoxShape box = kBox;
  box.obstacle = obstacle;
  box.open_top = open_top;
  return box;
}

std::vector<Case> cases() {
  return {{"plane", PlaneShape{.point = {0.1, 0.2, -0.1}, .normal = Vec3(1, 2, 2) / 3.0},
           [](const Vec3& p) { return (p - Vec3(0.1, 0.2, -0.1)).dot(Vec3(1, 2, 2)) < 0; }},
          {"container", variantOf(false, false), [](const Vec3& p) { return !insideBox(p); }},
          {"openContainer", variantOf(false, true),
           [](const Vec3& p) {
             return !insideBox({p.x(), p.y(), std::min(p.z(), kBox.upper.z() - 1e-6)});
           }},
          {"obstacle", variantOf(true, false), insideBox},
          {"bowl", kBowl, [](const Vec3& p) { return behindBowl(kBowl, p); }},
          {"hemisphere", kHemisphere, [](const Vec3& p) { return behindBowl(kHemisphere, p); }}};
}

class SignedDistanceTest : public testing::TestWithParam<Case> {};

// The nearest grid point of the other side is at most one cell's diagonal further than the surface, and never nearer.
TEST_P(SignedDistanceTest, agreesWithBruteForce) {
  const auto& [name, shape, in_tissue] = GetParam();
  const int cells = 72;
  const double from = -2.0;
  const double cell = -2.0 * from / cells;
  std::vector<Vec3> tissue;
  std::vector<Vec3> blood;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        const Vec3 p = Vec3::Constant(from) + cell * Vec3(i + 0.5, j + 0.5, k + 0.5);
        (in_tissue(p) ? tissue : blood).push_back(p);
      }
    }
  }
  PointStream points;
  for (int n = 0; n < 60; ++n) {
    const Vec3 p = points.nextPoint(-1.2, 1.2);
    const bool inside = in_tissue(p);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& other : inside ? blood : tissue) nearest = std::min(nearest, (other - p).norm());
    const double value = signedDistance(shape, p).value;
    EXPECT_EQ(value < 0, inside) << name << " " << p.transpose();
    if (nearest > 0.8) continue;  // beyond the grid there may be something nearer
    EXPECT_LE(std::abs(value), nearest + 1e-9) << name << " " << p.transpose();
    EXPECT_GE(std::abs(value), nearest - 1.8 * cell) << name << " " << p.transpose();
  }
}

TEST_P(SignedDistanceTest, normalIsTheUnitGradient) {
  const auto& [name, shape, in_tissue] = GetParam();
  PointStream points;
  const double step = 1e-6;
  int smooth = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = points.nextPoint(-1.2, 1.2);
    const auto at = signedDistance(shape, p);
    const Vec3 normal(at.normal[0], at.normal[1], at.normal[2]);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 along = step * Vec3::Unit(axis);
      gradient[axis] = (signedDistance(shape, p + along).value - signedDistance(shape, p - along).value) / (2.0 * step);
    }
    if (std::abs(gradient.norm() - 1.0) > 1e-4) continue;  // across a medial surface
    ++smooth;
    EXPECT_LT((gradient - normal).norm(), 1e-4) << name << " " << p.transpose();
    EXPECT_NEAR(signedDistance(shape, p - at.value * normal).value, 0.0, 1e-9) << name << " " << p.transpose();
  }
  EXPECT_GT(smooth, 480);
}

TEST_P(SignedDistanceTest, isFiniteWhereTheGradientIsNot) {
  const TissueShape& shape = GetParam().shape;
  const std::vector<Vec3> odd{kBox.lower,
                              kBox.upper,
                              0.5 * (kBox.lower + kBox.upper),
                              kBowl.rim_center,
                              kBowl.rim_center + Vec3(0, 0, kBowl.sphere_radius - kBowl.depth),
                              kHemisphere.rim_center + Vec3(kHemisphere.sphere_radius, 0, 0),
                              Vec3::Zero(),
                              Vec3(1e6, -1e6, 1e6)};
  for (const Vec3& p : odd) {
    const auto at = signedDistance(shape, p);
    EXPECT_TRUE(std::isfinite(at.value)) << p.transpose();
    EXPECT_NEAR(vectorLength(at.normal[0], at.normal[1], at.normal[2]), 1.0, 1e-12) << p.transpose();
    EXPECT_TRUE(std::isfinite(at.curvature));
  }
}

INSTANTIATE_TEST_SUITE_P(shapes, SignedDistanceTest, testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(BowlSurface, knownPoints) {
  const BowlSurface<double> bowl{kHemisphere};
  EXPECT_NEAR(bowl.at(0, 0, -0.7).value, 0.1, 1e-12);
  EXPECT_NEAR(bowl.at(0, 0, -0.7).curvature, 1.0 / 0.8, 1e-12);
  EXPECT_NEAR(bowl.at(2, 0, 0.3).value, 0.3, 1e-12);
  EXPECT_EQ(bowl.at(2, 0, 0.3).curvature, 0.0);
  const auto edge = bowl.at(0.5, 0, 0.4);
  EXPECT_NEAR(edge.value, 0.5, 1e-12);
  EXPECT_NEAR(edge.normal[0], -0.6, 1e-12) << "off the rim, towards the axis";
  EXPECT_NEAR(edge.normal[2], 0.8, 1e-12);
}

TEST(ObstacleSurface, edgesAreRound) {
  const ObstacleSurface<float> block{{.lower = {-1, -1, -1}, .upper = {1, 1, 1}, .obstacle = true}};
  const auto edge = block.at(1.3f, 0.0f, 1.4f);
  EXPECT_NEAR(edge.value, 0.5f, 1e-6f);
  EXPECT_NEAR(edge.normal[0], 0.6f, 1e-6f);
  EXPECT_NEAR(block.faceDistance(1.3f, 0.0f, 1.4f), 0.4f, 1e-6f);
  EXPECT_NEAR(block.at(0.8f, 0.0f, 0.0f).value, -0.2f, 1e-6f);
}

}  // namespace
}  // namespace bleedsim::sph
