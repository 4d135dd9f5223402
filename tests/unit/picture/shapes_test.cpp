// Rays on tissue.
#include "service/picture/shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;

const Ray kDown{{0.003, 0.002, 1.0}, {0, 0, -1}};
const BowlShape kBowl{{0, 0, 0.1}, 0.05, 0.02};

TEST(Shapes, planeIsSeenFromItsFrontOnly) {
  const PlaneShape plane{{0, 0, 0.25}, {0, 0, 2}};
  const auto hit = hitShape(plane, kDown);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->depth, 0.75, 1e-12);
  EXPECT_LT((hit->normal - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((hit->mark - Eigen::Vector2d{0.003, 0.002}).norm(), 1e-12);
  EXPECT_FALSE(hitShape(plane, {{0, 0, -1}, {0, 0, 1}})) << "from behind";
  EXPECT_FALSE(hitShape(plane, {{0, 0, 1}, {0, 0, 1}})) << "looking away";
  EXPECT_FALSE(hitShape(plane, {{0, 0, 1}, {1, 0, 0}})) << "along it";
}

TEST(Shapes, planeMayBeASquare) {
  const PlaneShape square{{1, 0, 0}, {0, 0, 1}, 0.5};
  EXPECT_TRUE(hitShape(square, {{1.49, -0.49, 1}, {0, 0, -1}}));
  EXPECT_FALSE(hitShape(square, {{1.51, 0, 1}, {0, 0, -1}}));
  EXPECT_FALSE(hitShape(square, {{1, 0.51, 1}, {0, 0, -1}}));
}

TEST(Shapes, obstacleShowsItsOuterFaces) {
  const BoxShape box{{-1, -1, 0}, {1, 1, 0.5}};
  const auto top = hitShape(box, kDown);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->depth, 0.5, 1e-12);
  EXPECT_EQ(top->normal, (Vec3{0, 0, 1}));
  const auto side = hitShape(box, {{-3, 0, 0.25}, {1, 0, 0}});
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->depth, 2.0, 1e-12);
  EXPECT_EQ(side->normal, (Vec3{-1, 0, 0}));
  EXPECT_FALSE(hitShape(box, {{-3, 0, 0.75}, {1, 0, 0}})) << "over it";
  EXPECT_FALSE(hitShape(box, {{3, 0, 0.25}, {1, 0, 0}})) << "behind the eye";
}

TEST(Shapes, containerIsCutOpen) {
  const BoxShape closed{{-1, -1, 0}, {1, 1, 0.5}, true, false};
  const auto floor = hitShape(closed, kDown);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->depth, 1.0, 1e-12) << "the floor inside, not the lid";
  EXPECT_EQ(floor->normal, (Vec3{0, 0, 1}));
  const auto wall = hitShape(closed, {{-3, 0, 0.25}, {1, 0, 0}});
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->depth, 4.0, 1e-12);
  EXPECT_EQ(wall->normal, (Vec3{-1, 0, 0}));

  const Ray up{{0, 0, 0.1}, {0, 0, 1}};
  BoxShape open = closed;
  open.open_top = true;
  EXPECT_TRUE(hitShape(closed, up));
  EXPECT_FALSE(hitShape(open, up));
}

TEST(Shapes, bowlHasItsRimAndItsHollow) {
  // The rim circle's radius is sqrt(R^2 - (R - depth)^2) = 0.04 m.
  const auto bottom = hitShape(kBowl, {{0, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(bottom);
  EXPECT_NEAR(bottom->depth, 0.9 + 0.02, 1e-12);
  EXPECT_LT((bottom->normal - Vec3::UnitZ()).norm(), 1e-12);
  const auto outside = hitShape(kBowl, {{0.0401, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(outside);
  EXPECT_NEAR(outside->depth, 0.9, 1e-12);

  const auto inside = hitShape(kBowl, {{0.0399, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(inside);
  const Vec3 at = Vec3{0.0399, 0, 1.0 - inside->depth};
  const Vec3 center{0, 0, 0.1 + 0.03};
  EXPECT_NEAR((at - center).norm(), 0.05, 1e-12);
  EXPECT_LT((inside->normal - (center - at) / 0.05).norm(), 1e-9) << "into the blood";
}

TEST(Shapes, bowlIsCutOpenFromTheSide) {
  const auto inside = hitShape(kBowl, {{0, -1, 0.09}, {0, 1, 0}});
  ASSERT_TRUE(inside);
  EXPECT_GT(inside->depth, 1.0) << "the far half of the hollow";
  EXPECT_FALSE(hitShape(kBowl, {{0, -1, 0.11}, {0, 1, 0}})) << "above the rim";
}

TEST(Shapes, edgeOnViewsCutThroughTissue) {
  const std::vector<Shape> plane{PlaneShape{}};
  EXPECT_TRUE(cutsThrough(plane, {{0, -1, -0.1}, {0, 1, 0}}));
  EXPECT_FALSE(cutsThrough(plane, {{0, -1, 0.1}, {0, 1, 0}}));
  EXPECT_FALSE(cutsThrough(plane, {{0, -1, -0.1}, {0, 1, 0.1}})) << "from below";
  EXPECT_TRUE(cutsThrough(std::vector<Shape>{kBowl}, {{0, -1, 0.05}, {0, 1, 0}}));
  EXPECT_FALSE(cutsThrough(std::vector<Shape>{BoxShape{{-1, -1, -1}, {1, 1, 1}}}, {{0, -1, -0.1}, {0, 1, 0}}));
}

TEST(Shapes, nearestOfAllIsHit) {
  const std::vector<Shape> shapes{PlaneShape{}, BoxShape{{-1, -1, 0}, {1, 1, 0.5}}, PlaneShape{{0, 0, -1}, {0, 0, 1}}};
  const auto hit = hitShapes(shapes, kDown);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->depth, 0.5, 1e-12);
  EXPECT_FALSE(hitShapes({}, kDown));
}

TEST(Shapes, badOnesAreRefusedByField) {
  const double nan = std::nan("");
  EXPECT_THAT(checkShape(PlaneShape{{0, 0, 0}, {0, 0, 0}}).message(), HasSubstr("normal has no length"));
  EXPECT_THAT(checkShape(PlaneShape{{nan, 0, 0}}).message(), HasSubstr("finite"));
  EXPECT_THAT(checkShape(PlaneShape{{0, 0, 0}, {0, 0, 1}, 0.0}).message(), HasSubstr("half size"));
  EXPECT_THAT(checkShape(BoxShape{{0, 0, 0}, {1, 1, 0}}).message(), HasSubstr("lower corner"));
  EXPECT_THAT(checkShape(BowlShape{{0, 0, 0}, 0.05, 0.06}).message(), HasSubstr("depth"));
  EXPECT_THAT(checkShape(BowlShape{{0, 0, 0}, 0.05, 0.0}).message(), HasSubstr("depth"));
  EXPECT_THAT(checkShape(BowlShape{{0, 0, 0}, nan, 0.01}).message(), HasSubstr("finite"));
  EXPECT_TRUE(checkShape(kBowl).ok());
}

}  // namespace
}  // namespace bleedsim::picture::test
