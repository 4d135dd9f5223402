// Scenes that are legal and that nobody means: they run, or are refused with the figure that decides.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "service/daemon/scene_loader.h"
#include "tests/support/flat_scene.h"

namespace bleedsim::daemon {
namespace {

using testing::HasSubstr;

constexpr double kAnyStep = std::numeric_limits<double>::infinity();

std::string flatScene(double half_side, double height, std::uint32_t capacity, double spacing, const std::string& more) {
  return test::FlatScene{.half_side = half_side, .height = height, .capacity = capacity, .spacing = spacing, .more = more}.text();
}

Result<LoadedScene> load(const std::string& text) { return worldFactory({.threads = 2})({text, nullptr}); }

TEST(AbsurdScene, AMillionParticlesRun) {
  // 100 x 100 x 100 spacings.
  const auto loaded = load(flatScene(0.12, 0.25, 1'000'000, 0.002,
                                     "fluid_blocks { lower_m { x: -0.1 y: -0.1 z: 0.001 } upper_m { x: 0.1 y: 0.1 z: 0.201 } }"));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->world->particleCount(), 1'000'000U);
  EXPECT_TRUE(loaded->world->step(kAnyStep).ok());
  EXPECT_FALSE(loaded->world->faulted());
}

TEST(AbsurdScene, MoreParticlesThanAWorldHoldsAreRefusedWithTheBound) {
  const auto loaded = load(flatScene(0.12, 0.25, 2'000'001, 0.002, ""));
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.status().message(), HasSubstr("domain.capacity: value 2000001 is out of range, allowed 1 to 2000000"));
}

/// A disc of 1e-9 m^2: a hundredth of a cell of the rest lattice is wide enough to bleed through.
TEST(AbsurdScene, AWoundOfAThousandthOfASquareMillimetreBleedsAsItIsTold) {
  const double radius = std::sqrt(1e-9 / M_PI);
  const double flow_ml_per_s = 2e-4;  // 0.2 m/s
  const auto loaded = load(flatScene(
      0.06, 0.06, 12000, 0.003, fmt::format("wounds {{ disc {{ radius_m: {} }} flow_ml_per_s: {} }}", radius, flow_ml_per_s)));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  sph::World& world = *loaded->world;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(world.step(kAnyStep).ok());
  sph::WorldStats stats;
  world.collectStats(stats);
  EXPECT_NEAR(stats.commanded_volume, flow_ml_per_s * 1e-6 * world.time(), 1e-6 * stats.commanded_volume);
  EXPECT_EQ(stats.particles, 0U) << "one particle is 27 uL, 50 steps bleed less";
}

TEST(AbsurdScene, TooFastThroughSoSmallAWoundIsRefusedWithWhatItWouldTake) {
  const auto loaded = load(flatScene(0.06, 0.06, 12000, 0.003, "wounds { disc { radius_m: 1.784e-5 } flow_ml_per_s: 1 }"));
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.status().message(), HasSubstr("allowed 0 to 0.000299"));
  EXPECT_THAT(loaded.status().message(), HasSubstr("lower it or widen the patch"));
  EXPECT_THAT(loaded.status().message(), testing::Not(HasSubstr("design_speed_m_per_s to 1010"))) << "20 m/s is the most";
}

TEST(AbsurdScene, AThousandWoundsInATextAreRefusedWithTheBoundAndAWay) {
  std::string wounds = "commands { max_wounds: 1023 }\n";
  for (int i = 0; i < 1000; ++i) {
    const int row = i / 32;
    wounds += fmt::format("wounds {{ position_m {{ x: {:.3f} y: {:.3f} }} disc {{ radius_m: 0.0005 }} flow_ml_per_s: 0.01 }}\n",
                          -0.19 + 0.012 * (i % 32), -0.19 + 0.012 * row);
  }
  const auto loaded = load(flatScene(0.2, 0.03, 20000, 0.003, wounds));
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.status().message(),
              HasSubstr("wounds: 1000 are given, allowed are at most 64; open further ones by command"));
}

TEST(AbsurdScene, AThousandWoundsByCommandRun) {
  const auto loaded = load(flatScene(0.2, 0.03, 20000, 0.003, "commands { max_wounds: 1000 }"));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  sph::World& world = *loaded->world;
  sph::WoundDescription wound;
  wound.normal = {0.0, 0.0, 1.0};
  wound.shape = sph::DiscPatch{0.0005};
  wound.drive = sph::FlowDrive{1e-8};
  for (int i = 0; i < 1000; ++i) {
    const int row = i / 32;
    wound.position = {-0.19 + 0.012 * (i % 32), -0.19 + 0.012 * row, 0.0};
    const auto added = world.apply(sph::AddWound{wound});
    ASSERT_TRUE(added.ok()) << i << ": " << added.status().message();
  }
  wound.position = {0.195, 0.195, 0.0};
  const auto more = world.apply(sph::AddWound{wound});
  ASSERT_FALSE(more.ok());
  EXPECT_EQ(more.status().code(), StatusCode::capacity);
  EXPECT_THAT(more.status().message(), HasSubstr("1000"));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(world.step(kAnyStep).ok());
  EXPECT_EQ(world.wounds().size(), 1000U);
}

}  // namespace
}  // namespace bleedsim::daemon
