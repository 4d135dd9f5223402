// What guards the solver: refusals and the projection out of tissue.
#include <gmock/gmock.h>
#include <limits>

#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string refusalOf(const TissueDescription& tissue) {
  const auto field = TissueField<float>::create({tissue}, settingsFor(2.0));
  EXPECT_FALSE(field.ok());
  EXPECT_EQ(field.status().code(), StatusCode::invalid_argument);
  return field.status().message();
}

TEST(TissueNet, refusesWhatHasNoSurface) {
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_THAT(refusalOf(tissueOf(PlaneShape{.normal = Vec3::Zero()})), AllOf(HasSubstr("'test'"), HasSubstr("normal")));
  EXPECT_THAT(refusalOf(tissueOf(PlaneShape{.normal = {0, kNan, 1}})), HasSubstr("normal"));
  EXPECT_THAT(refusalOf(tissueOf(PlaneShape{.point = {kNan, 0, 0}})), HasSubstr("point"));
  EXPECT_THAT(refusalOf(tissueOf(BoxShape{.lower = {0, 0, 0}, .upper = {1, 0, 1}})), HasSubstr("axis 1"));
  EXPECT_THAT(refusalOf(tissueOf(BoxShape{.lower = {0, 0, kNan}, .upper = {1, 1, 1}})), HasSubstr("axis 2"));
  EXPECT_THAT(refusalOf(tissueOf(BowlShape{.sphere_radius = -1.0, .depth = 0.1})), HasSubstr("sphere_radius is -1"));
  EXPECT_THAT(refusalOf(tissueOf(BowlShape{.sphere_radius = 1.0, .depth = 1.1})), HasSubstr("depth is 1.1"));
  EXPECT_THAT(refusalOf(tissueOf(BowlShape{.rim_center = {0, kNan, 0}, .sphere_radius = 1.0, .depth = 0.1})), HasSubstr("rim"));
  EXPECT_THAT(refusalOf(tissueOf(PlaneShape{}, 1.5)), HasSubstr("slip is 1.5"));
  EXPECT_THAT(refusalOf(tissueOf(PlaneShape{}, kNan)), HasSubstr("slip"));
}

TEST(TissueNet, refusesTooManyTissues) {
  const std::vector<TissueDescription> many(TissueField<float>::kMostTissues + 1, tissueOf(PlaneShape{}));
  const auto field = TissueField<float>::create(many, settingsFor(2.0));
  ASSERT_FALSE(field.ok());
  EXPECT_EQ(field.status().code(), StatusCode::capacity);
}

struct Scene {
  std::string name;
  std::vector<TissueDescription> tissue;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Scene& one, std::ostream* out) { *out << one.name; }

class TissueNetTest : public testing::TestWithParam<Scene> {};

TEST_P(TissueNetTest, projectionEndsInFrontOfEveryWall) {
  const auto field = fieldOf<float>(GetParam().tissue, 2.0);
  PointStream points;
  int inside = 0;
  for (int n = 0; n < 6000; ++n) {
    const Eigen::Vector3f p = points.nextPoint(-16 * kSpacing, 16 * kSpacing).cast<float>();
    std::array<float, 3> position{p.x(), p.y(), p.z()};
    std::array<float, 3> normal{};
    const float before = field.distance(p.x(), p.y(), p.z());
    const bool moved = field.project(position, normal);
    EXPECT_EQ(moved, before < 0);
    if (!moved) {
      EXPECT_EQ(position[0], p.x());
      EXPECT_EQ(position[2], p.z());
      continue;
    }
    ++inside;
    EXPECT_NEAR(vectorLength(normal[0], normal[1], normal[2]), 1.0f, 1e-5f);
    EXPECT_GE(field.distance(position[0], position[1], position[2]), 0.0f) << p.transpose();
  }
  EXPECT_GT(inside, 50);
}

std::vector<Scene> scenes() {
  const BoxShape box{.lower = Vec3::Constant(-8 * kSpacing), .upper = Vec3::Constant(8 * kSpacing)};
  BoxShape open = box;
  open.open_top = true;
  BoxShape block{.lower = Vec3::Constant(-5 * kSpacing), .upper = Vec3::Constant(3 * kSpacing), .obstacle = true};
  return {{"plane", {tissueOf(PlaneShape{.normal = {0.6, 0, 0.8}})}},
          {"container", {tissueOf(box)}},
          {"openContainer", {tissueOf(open)}},
          {"block", {tissueOf(block)}},
          {"bowl", {tissueOf(BowlShape{.sphere_radius = 12 * kSpacing, .depth = 9 * kSpacing})}},
          {"wedge", {tissueOf(PlaneShape{}), tissueOf(PlaneShape{.normal = {0.8, 0, 0.6}})}}};
}

INSTANTIATE_TEST_SUITE_P(shapes, TissueNetTest, testing::ValuesIn(scenes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::sph
