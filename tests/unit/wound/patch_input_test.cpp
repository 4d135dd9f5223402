#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "service/sph/wound/patch_geometry.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<Vec2> ring(std::size_t count) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    points.emplace_back(0.005 * std::cos(angle), 0.005 * std::sin(angle));
  }
  return points;
}

struct BadPatch {
  PatchShape shape;
  std::string says;  ///< what the message must name
};

TEST(CheckPatch, RefusesBadShapesByName) {
  const PolygonPatch bow_tie{{{0, 0}, {0.01, 0.01}, {0.01, 0}, {0, 0.01}}};
  const PolygonPatch pinched{{{0, 0}, {0.01, 0}, {0.005, 0.005}, {0.01, 0.01}, {0, 0.01}, {0.005, 0.005}}};
  const PolygonPatch spike{{{0, 0}, {0.01, 0}, {0.005, 0}}};
  const PolygonPatch closed_twice{{{0, 0}, {0.01, 0}, {0, 0.01}, {0, 0}}};
  const std::vector<BadPatch> table{
      {DiscPatch{0.0}, "radius is 0 m"},
      {DiscPatch{-0.001}, "radius is -0.001 m"},
      {DiscPatch{kNan}, "radius is nan"},
      {DiscPatch{kInf}, "radius is inf"},
      {DiscPatch{2.0}, "radius is 2 m; allowed are 1e-05 to 0.1 m"},
      {EllipsePatch{0.0, 0.001}, "semi_axis_u"},
      {EllipsePatch{0.001, kNan}, "semi_axis_v"},
      {PolygonPatch{{{0, 0}, {1, 0}}}, "2 points; allowed are 3 to 256"},
      {PolygonPatch{ring(257)}, "257 points"},
      {PolygonPatch{{{0, 0}, {0.01, kNan}, {0, 0.01}}}, "point 1"},
      {PolygonPatch{{{0, 0}, {0.01, 0}, {0, kInf}}}, "point 2"},
      {PolygonPatch{{{0, 0}, {0.01, 0}, {0, 1.5}}}, "1.5"},
      {bow_tie, "crosses itself"},
      {pinched, "crosses itself"},
      {spike, "folds back"},
      {closed_twice, "points 3 and 0 coincide"},
      {PolylinePatch{{{0, 0}}, 0.001}, "1 points; allowed are 2 to 256"},
      {PolylinePatch{ring(257), 0.001}, "257 points"},
      {PolylinePatch{{{0, 0}, {0, 0}}, 0.001}, "points 0 and 1 coincide"},
      {PolylinePatch{{{0, 0}, {0.01, 0}}, 0.0}, "width is 0"},
      {PolylinePatch{{{0, 0}, {0.01, kNan}}, 0.001}, "point 1"},
  };
  for (const BadPatch& bad : table) {
    const Status status = checkPatch(bad.shape);
    EXPECT_EQ(status.code(), StatusCode::invalid_argument) << bad.says;
    EXPECT_NE(status.message().find(bad.says), std::string::npos) << status.message() << " lacks: " << bad.says;
  }
}

TEST(CheckPatch, AcceptsTheLimits) {
  EXPECT_TRUE(checkPatch(DiscPatch{kPatchLength.lower}).ok());
  EXPECT_TRUE(checkPatch(DiscPatch{kPatchLength.upper}).ok());
  EXPECT_TRUE(checkPatch(PolygonPatch{ring(3)}).ok());
  EXPECT_TRUE(checkPatch(PolygonPatch{ring(256)}).ok());
  EXPECT_TRUE(checkPatch(PolylinePatch{ring(256), 0.001}).ok());
}

}  // namespace
}  // namespace bleedsim::sph
