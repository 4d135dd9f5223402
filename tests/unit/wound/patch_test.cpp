#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/patch_sites.h"

namespace bleedsim::sph {
namespace {

constexpr double kDx = 0.001;
constexpr double kPi = std::numbers::pi;

double nearestPair(const std::vector<Vec2>& sites) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = i + 1; j < sites.size(); ++j) nearest = std::min(nearest, (sites[i] - sites[j]).norm());
  }
  return nearest;
}

double furthest(const std::vector<Vec2>& sites) {
  double distance = 0.0;
  for (const Vec2& site : sites) distance = std::max(distance, site.norm());
  return distance;
}

struct ShapeCase {
  std::string name;
  PatchShape shape;
  double area;               ///< m^2, by hand
  std::size_t fewest, most;  ///< sites
};

std::vector<ShapeCase> shapeCases() {
  const PolygonPatch square{{{-0.005, -0.005}, {0.005, -0.005}, {0.005, 0.005}, {-0.005, 0.005}}};
  const PolygonPatch letter_l{{{0, 0}, {0.01, 0}, {0.01, 0.002}, {0.002, 0.002}, {0.002, 0.01}, {0, 0.01}}};
  const PolygonPatch clockwise{{{0, 0}, {0, 0.004}, {0.003, 0}}};
  const double slant = 0.01 / std::numbers::sqrt2;
  const PolygonPatch sliver{{{0, 0}, {slant, slant}, {slant - 1e-4, slant + 1e-4}, {-1e-4, 1e-4}}};
  return {
      {"Disc", DiscPatch{0.005}, kPi * 25e-6, 76, 90},
      {"SmallDisc", DiscPatch{0.0004}, kPi * 0.16e-6, 1, 1},
      {"TinyDisc", DiscPatch{1e-5}, kPi * 1e-10, 1, 1},
      {"Ellipse", EllipsePatch{0.008, 0.003}, kPi * 24e-6, 73, 85},
      {"NarrowEllipse", EllipsePatch{0.008, 0.0003}, kPi * 2.4e-6, 12, 17},
      {"Square", square, 1e-4, 100, 100},
      {"LetterL", letter_l, 36e-6, 33, 42},
      {"ClockwiseTriangle", clockwise, 6e-6, 5, 9},
      {"Sliver", sliver, 0.01 * std::numbers::sqrt2 * 1e-4, 9, 11},
      {"NarrowIncision", PolylinePatch{{{-0.01, 0}, {0.01, 0}}, 0.0005}, 0.02 * 0.0005 + kPi * 0.0625e-6, 20, 20},
      {"BentIncision", PolylinePatch{{{0, 0}, {0.01, 0}, {0.01, 0.01}}, 0.003}, 0.06e-3 + kPi * 2.25e-6, 55, 72},
      {"ShortIncision", PolylinePatch{{{0, 0}, {0.0005, 0}}, 0.005}, 2.5e-6 + kPi * 6.25e-6, 19, 30},
  };
}

TEST(PatchSites, EveryShapeHasItsAreaAndSitesThatMakeItUp) {
  for (const ShapeCase& entry : shapeCases()) {
    SCOPED_TRACE(entry.name);
    EXPECT_NEAR(patchArea(entry.shape), entry.area, 1e-9 * entry.area);
    const auto patch = makePatchSites(entry.shape, kDx);
    ASSERT_TRUE(patch.ok()) << patch.status().message();
    EXPECT_GE(patch->sites.size(), entry.fewest);
    EXPECT_LE(patch->sites.size(), entry.most);
    EXPECT_GE(nearestPair(patch->sites), 0.999 * kDx);
    EXPECT_LE(furthest(patch->sites), boundingRadius(entry.shape) + 1e-9 * kDx);
    EXPECT_GE(patch->gap, kDx);
    const double sites = static_cast<double>(patch->sites.size());
    EXPECT_NEAR(patch->gap, std::max(kDx, sites * kDx * kDx * kDx / entry.area), 1e-12 * patch->gap);
  }
}

TEST(PatchSites, AFullLatticeMovesAtFlowOverArea) {
  for (const double radius : {0.002, 0.0033, 0.005, 0.0141, 0.05}) {
    const auto patch = makePatchSites(DiscPatch{radius}, kDx);
    ASSERT_TRUE(patch.ok());
    const double wanted = patch->area / (kDx * kDx);
    EXPECT_NEAR(static_cast<double>(patch->sites.size()) / wanted, 1.0, 0.35) << radius;
    const double speed_ratio = patch->gap * patch->area / (static_cast<double>(patch->sites.size()) * kDx * kDx * kDx);
    EXPECT_GE(speed_ratio, 1.0 - 1e-9) << radius;
    EXPECT_LE(speed_ratio, 1.05) << radius;
  }
}

TEST(PatchSites, ConcavePolygonHasNoSiteInItsNotch) {
  const PolygonPatch letter_l{{{0, 0}, {0.01, 0}, {0.01, 0.002}, {0.002, 0.002}, {0.002, 0.01}, {0, 0.01}}};
  const auto patch = makePatchSites(letter_l, kDx);
  ASSERT_TRUE(patch.ok());
  for (const Vec2& site : patch->sites) EXPECT_FALSE(site.x() > 0.0021 && site.y() > 0.0021) << site.transpose();
}

TEST(PatchSites, SelfCrossingPolylineKeepsItsDistances) {
  const PolylinePatch zigzag{{{0, 0}, {0.02, 0.001}, {0, 0.002}, {0.02, 0.003}, {0.01, -0.01}, {0.01, 0.01}}, 0.0025};
  const auto patch = makePatchSites(zigzag, kDx);
  ASSERT_TRUE(patch.ok());
  EXPECT_GT(patch->sites.size(), 40u);
  EXPECT_GE(nearestPair(patch->sites), 0.999 * kDx);
}

TEST(PatchSites, TooManySitesAreRefusedWithTheLimit) {
  const auto wide = makePatchSites(DiscPatch{0.1}, 2e-4);
  ASSERT_FALSE(wide.ok());
  EXPECT_EQ(wide.status().code(), StatusCode::capacity);
  EXPECT_NE(wide.status().message().find("65535"), std::string::npos) << wide.status().message();
  const auto far = makePatchSites(PolylinePatch{{{0, 0}, {0.1, 0}}, 1e-5}, 2e-5);
  ASSERT_FALSE(far.ok());
  EXPECT_EQ(far.status().code(), StatusCode::capacity);
  EXPECT_NE(far.status().message().find("0.08192"), std::string::npos) << far.status().message();
}

TEST(PatchFrame, IsOrthonormalForEveryNormalAndTangent) {
  for (const Vec3& normal : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-3, 2, 0.1}, Vec3{1e-9, 1e-9, 1e-9}, Vec3{1e200, 1e200, 0}}) {
    for (const Vec3& tangent : {Vec3{0, 0, 0}, Vec3{0, 0, 5}, Vec3{1, 1, 0}, normal}) {
      const auto frame = makePatchFrame({1, 2, 3}, normal, tangent);
      ASSERT_TRUE(frame.ok()) << frame.status().message();
      Eigen::Matrix3d axes;
      axes << frame->u, frame->v, frame->normal;
      EXPECT_TRUE((axes.transpose() * axes).isApprox(Eigen::Matrix3d::Identity(), 1e-12));
      EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
      EXPECT_NEAR(frame->toLocal(frame->toWorld({4, 5}, 6) - frame->origin).z(), 6.0, 1e-12);
    }
  }
  const auto turned = makePatchFrame(Vec3::Zero(), {0, 0, 2}, {0, 3, 7});
  ASSERT_TRUE(turned.ok());
  EXPECT_TRUE(turned->u.isApprox(Vec3{0, 1, 0}, 1e-12));
}

}  // namespace
}  // namespace bleedsim::sph
