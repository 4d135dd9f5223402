// Every SIMD target is the scalar twin to rounding: one step of whole worlds from the same input.
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/unit/sph/frame_differences.h"
#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

struct Case {
  std::string name;
  std::function<WorldDescription()> describe;
};

WorldDescription harmonic(WorldDescription description) {
  FluidBlock second = description.fluid_blocks.front();
  FluidBlock& first = description.fluid_blocks.front();
  const double middle = first.lower.x() + 0.5 * (first.upper.x() - first.lower.x());
  first.upper.x() = middle;
  second.lower.x() = middle;
  second.viscosity = 0.02;
  second.velocity = {0.05, 0.2, -0.1};
  description.fluid_blocks.push_back(second);
  return description;
}

WorldDescription bleeding() {
  WorldDescription description = test::woundOnPlane(0.003, 6e-6);
  FluidBlock pool;
  pool.lower = {-0.008, -0.008, 0.0};
  pool.upper = {0.008, 0.008, 0.006};
  pool.jitter = 0.2;
  description.fluid_blocks.push_back(pool);
  return description;
}

/// Two blocks that meet, with a flow curve and platelets of different age.
WorldDescription clotting(WorldDescription description) {
  description = harmonic(description);
  description.effects.viscosity->rheology = CassonRheology{};
  description.effects.platelets.emplace();
  description.effects.platelets->diffusivity = 1e-4;
  description.effects.platelets->clot_speedup = 1000.0;
  description.fluid_blocks.back().platelet = 0.6;
  return description;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> kAll = [] {
    std::vector<Case> scenes{
        {"FreeBlock",
         [] {
           return test::freeBlock({11, 9, 10}, 0.3);
         }},
        {"Periodic",
         [] {
           return test::periodicBox({10, 8, 9}, 0.3);
         }},
        {"Harmonic",
         [] {
           return harmonic(test::freeBlock({12, 9, 9}, 0.3));
         }},
        {"HarmonicPeriodic",
         [] {
           return harmonic(test::periodicBox({12, 8, 8}, 0.3));
         }},
        {"ClosedBox",
         [] {
           return test::closedBox({9, 8, 10}, 0.2);
         }},
        {"Bleeding", bleeding},
        {"Clotting",
         [] {
           return clotting(test::freeBlock({12, 9, 9}, 0.3));
         }},
        {"ClottingPeriodic",
         [] {
           return clotting(test::periodicBox({12, 8, 8}, 0.3));
         }},
    };
    for (const PairSet& set : allPairSets()) {
      scenes.push_back({nameOf(set), [set] {
                          WorldDescription description = withPairSet(test::freeBlock({9, 8, 8}, 0.2), set);
                          description.fluid_blocks.front().velocity = {0.1, -0.2, 0.05};
                          return description;
                        }});
    }
    return scenes;
  }();
  return kAll;
}

class SimdWorld : public testing::TestWithParam<Case> {};

TEST_P(SimdWorld, OneStepIsThatOfTheScalarTwin) {
  const WorldDescription description = GetParam().describe();
  const auto scalar = test::makeWorld(description, {.simd = SimdTarget::scalar});
  ASSERT_TRUE(scalar->step(1.0).ok());
  const FrameBuffer expected = test::frameOf(*scalar);
  ASSERT_GT(expected.count, 500u);
  ASSERT_GT(test::statsOf(*scalar).max_speed, 1e-4) << "nothing moves";
  for (const SimdTarget target : availableSimdTargets()) {
    const auto world = test::makeWorld(description, {.simd = target});
    ASSERT_EQ(world->simdTarget(), target);
    ASSERT_TRUE(world->step(1.0).ok());
    EXPECT_NEAR(world->time(), scalar->time(), 1e-6 * scalar->time());
    expectAlike(test::frameOf(*world), expected, simdTargetName(target));
  }
}

TEST_P(SimdWorld, SinglePrecisionFollowsTheReference) {
  const WorldDescription description = GetParam().describe();
  const auto reference = test::makeWorld(description, {.precision = Precision::float64});
  EXPECT_EQ(reference->simdTarget(), SimdTarget::scalar);
  ASSERT_TRUE(reference->step(1.0).ok());
  const auto world = test::makeWorld(description);
  EXPECT_EQ(world->simdTarget(), availableSimdTargets().front());
  ASSERT_TRUE(world->step(1.0).ok());
  ASSERT_EQ(world->particleCount(), reference->particleCount());
  const Differences apart = compare(test::frameOf(*world), test::frameOf(*reference));
  EXPECT_LT(apart.position, 1e-5);
  EXPECT_LT(apart.velocity, 1e-4);
  EXPECT_LT(apart.density, 1e-5);
}

TEST_P(SimdWorld, ThreadsDoNotChangeABit) {
  const WorldDescription description = GetParam().describe();
  const auto one = test::makeWorld(description, {.threads = 1});
  const auto three = test::makeWorld(description, {.threads = 3});
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(one->step(1.0).ok());
    ASSERT_TRUE(three->step(1.0).ok());
    ASSERT_EQ(one->stateHash(), three->stateHash()) << "step " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SimdWorld, testing::ValuesIn(cases()), [](const auto& scene) { return scene.param.name; });

TEST(SimdTargets, NamesAreReadBack) {
  for (const SimdTarget target : {SimdTarget::automatic, SimdTarget::scalar, SimdTarget::avx2, SimdTarget::avx512}) {
    const Result<SimdTarget> read = parseSimdTarget(simdTargetName(target));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, target);
  }
  EXPECT_EQ(simdTargetName(SimdTarget::automatic), "auto");
}

TEST(SimdTargets, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  for (const char* name : {"", "AVX2", "avx2 ", "automatic", "neon"}) {
    const Result<SimdTarget> read = parseSimdTarget(name);
    ASSERT_FALSE(read.ok()) << name;
    EXPECT_EQ(read.status().code(), StatusCode::not_found);
    for (const char* known : {"auto", "scalar", "avx2", "avx512"}) {
      EXPECT_NE(read.status().message().find(known), std::string::npos) << known;
    }
  }
}

TEST(SimdTargets, ScalarIsAlwaysThereAndLast) {
  const std::vector<SimdTarget> targets = availableSimdTargets();
  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(targets.back(), SimdTarget::scalar);
  EXPECT_EQ(std::count(targets.begin(), targets.end(), SimdTarget::automatic), 0);
  EXPECT_TRUE(std::is_sorted(targets.rbegin(), targets.rend())) << "best first";
}

}  // namespace
}  // namespace bleedsim::sph
