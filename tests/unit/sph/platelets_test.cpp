// Platelets: what each sink does to a particle, and that blood brings its own. The closed forms of diffusion and activation are
// in tests/validation/sph/clotting_test.cpp.
#include "service/sph/effects/platelets.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/unit/sph/thinning.h"

namespace bleedsim::sph {
namespace {

/// Diffusion and every sink off.
PlateletSettings still() {
  PlateletSettings settings;
  settings.diffusivity = 0.0;
  settings.activation_rate = 0.0;
  settings.wall_rate = 0.0;
  settings.air_rate = 0.0;
  return settings;
}

void run(World& world, double seconds) {
  while (world.time() < seconds) ASSERT_TRUE(world.step(seconds - world.time() + 1e-12).ok());
}

FrameBuffer after(const WorldDescription& description, double seconds) {
  const auto world = test::makeWorld(description);
  run(*world, seconds);
  return test::frameOf(*world);
}

TEST(Platelets, StayWithoutSinks) {
  WorldDescription description = test::freeBlock({6, 6, 6}, 0.2);
  description.effects.platelets = still();
  const FrameBuffer frame = after(description, 0.005);
  for (std::size_t i = 0; i < frame.count; ++i) EXPECT_EQ(frame.platelet[i], 0.99f);
}

// dP/dt = -s k_a A_a P: P = 0.99 exp(-s k_a t) where air is all around, P = 0.99 in the middle. First order in dt: half of s k_a
// dt = 0.4 % of the exponent.
TEST(Platelets, AirTakesThoseOfIsolatedParticlesAndLeavesTheMiddle) {
  WorldDescription description = test::freeBlock({7, 7, 7});
  description.effects.platelets = still();
  description.effects.platelets->air_rate = 1.0;
  description.effects.platelets->clot_speedup = 100.0;
  FluidBlock lonely = description.fluid_blocks[0];
  lonely.lower = {0.02, 0.0, 0.0};
  lonely.upper = lonely.lower + Vec3::Constant(test::kSpacing);
  description.fluid_blocks.push_back(lonely);
  const FrameBuffer frame = after(description, 0.01);
  int middle = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const Vec3 x = test::positionOf(frame, i);
    if (x.x() > 0.01) {
      EXPECT_NEAR(frame.platelet[i], 0.99 * std::exp(-1.0), 0.01 * 0.37);
    } else if (x.cwiseAbs().maxCoeff() < 0.0015) {
      EXPECT_EQ(frame.platelet[i], 0.99f);
      ++middle;
    }
  }
  EXPECT_EQ(middle, 27);
}

// P/(1 + k_a t) with the t of all steps since the time before.
TEST(Platelets, AreAdvancedEveryEighthStepByTheTimeOfAll) {
  WorldDescription description = test::freeBlock({1, 1, 1});
  description.effects.platelets = still();
  description.effects.platelets->air_rate = 1.0;
  const auto world = test::makeWorld(description);
  std::vector<std::uint64_t> advanced;
  float platelet = 0.99f;
  double since = 0.0;
  for (int k = 0; k < 40; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    const float now = test::frameOf(*world).platelet[0];
    if (now == platelet) continue;
    EXPECT_NEAR(now, double(platelet) / (1.0 + world->time() - since), 2e-7);
    advanced.push_back(world->stepCount());
    platelet = now;
    since = world->time();
  }
  EXPECT_EQ(advanced, (std::vector<std::uint64_t>{9, 17, 25, 33}));
}

// No sink may act for longer than 1/200 of its time at once.
TEST(Platelets, AreAdvancedMoreOftenWhereTheyClotFast) {
  WorldDescription description = test::freeBlock({1, 1, 1});
  description.effects.platelets = still();
  description.effects.platelets->air_rate = 1.0;
  description.effects.platelets->clot_speedup = 1e4;
  const auto world = test::makeWorld(description);
  float platelet = 0.99f;
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    const float now = test::frameOf(*world).platelet[0];
    EXPECT_LT(now, platelet);
    platelet = now;
  }
}

// A_w is 1 half a spacing from tissue and 0 at h = 2.5 dx, where the third row stands.
TEST(Platelets, TissueTakesThoseOfTheFirstRows) {
  WorldDescription description = test::closedBox({8, 8, 8});
  description.effects.platelets = still();
  description.support_ratio = 2.5;
  description.effects.platelets->wall_rate = 100.0;
  const FrameBuffer frame = after(description, 0.01);
  for (std::size_t i = 0; i < frame.count; ++i) {
    const Vec3 x = test::positionOf(frame, i) / test::kSpacing;
    const double depth = std::min(x.minCoeff(), (Vec3::Constant(8.0) - x).minCoeff());
    if (depth < 1.0) {
      EXPECT_NEAR(frame.platelet[i], 0.99 * std::exp(-1.0), 0.01 * 0.37);
    } else if (depth > 2.0) {
      EXPECT_EQ(frame.platelet[i], 0.99f);
    } else {
      EXPECT_LT(frame.platelet[i], 0.985f);
      EXPECT_GT(frame.platelet[i], 0.5f);
    }
  }
}

// phi = max(0, 1 - g/g_0): blood that shears at twice the gate stays liquid, at half the gate it clots half as fast. Rates are of
// the first step.
TEST(Platelets, ShearKeepsBloodLiquid) {
  const auto lost = [](double gate) {
    WorldDescription description = withFlow(test::freeBlock({7, 7, 7}), [](const Vec3& x) { return Vec3{200.0 * x.z(), 0, 0}; });
    description.effects.viscosity->rheology = NewtonianRheology{};
    description.effects.platelets = still();
    description.effects.platelets->activation_rate = 100.0;  // fast enough to be due in every step
    description.effects.platelets->shear_gate = gate;
    description.effects.platelets->fresh = 0.5;
    const auto world = test::makeWorld(description);
    EXPECT_TRUE(world->step(1.0).ok());
    const FrameBuffer frame = test::frameOf(*world);
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.count; ++i) sum += 0.5 - double(frame.platelet[i]);
    return sum / frame.count;
  };
  EXPECT_EQ(lost(100.0), 0.0);
  const double open = lost(std::numeric_limits<double>::infinity());
  EXPECT_GT(open, 1e-5);
  EXPECT_NEAR(lost(400.0) / open, 0.5, 0.02);  // one step changes g by a percent
}

TEST(Platelets, ComeFreshOutOfAWound) {
  WorldDescription description = test::woundOnPlane(0.003, 6e-6);
  description.effects.platelets.emplace();
  description.effects.platelets->fresh = 0.9;
  description.effects.platelets->clot_speedup = 200.0;
  const auto world = test::makeWorld(description);
  run(*world, 0.05);
  const FrameBuffer frame = test::frameOf(*world);
  ASSERT_GT(frame.count, 100u);
  float largest = 0.0f;
  float smallest = 1.0f;
  for (std::size_t i = 0; i < frame.count; ++i) {
    largest = std::max(largest, frame.platelet[i]);
    smallest = std::min(smallest, frame.platelet[i]);
  }
  EXPECT_EQ(largest, 0.9f) << "what has just crossed the patch";
  EXPECT_LT(smallest, 0.88f);
  EXPECT_GE(smallest, 0.0f);
}

// A rate beyond every time step still ends at P = 0, never below.
TEST(Platelets, StayBetweenZeroAndOneHoweverFast) {
  WorldDescription description = test::closedBox({6, 6, 6}, 0.2);
  description.effects.platelets.emplace();
  description.effects.platelets->clot_speedup = 1e9;
  description.effects.platelets->diffusivity = 1e-5;
  const FrameBuffer frame = after(description, 0.001);
  for (std::size_t i = 0; i < frame.count; ++i) {
    EXPECT_GE(frame.platelet[i], 0.0f);
    EXPECT_LT(frame.platelet[i], 1e-3f);
  }
}

// dt <= 0.045 h^2/k.
TEST(Platelets, DiffusionBoundsTheTimeStep) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.effects.platelets = still();
  description.effects.platelets->diffusivity = 0.01;
  const auto world = test::makeWorld(description);
  ASSERT_TRUE(world->step(1.0).ok());
  const double h = description.supportRadius();
  EXPECT_NEAR(test::statsOf(*world).dt, 0.045 * h * h / 0.01, 1e-12);
}

TEST(Platelets, AFrameHasThemOnDemand) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.capacity = 64;
  for (const bool present : {false, true}) {
    if (present) {
      description.effects.platelets.emplace();
      description.fluid_blocks[0].platelet = 0.25;
    }
    const auto world = test::makeWorld(description);
    FrameBuffer frame;
    frame.reserve(64, kFramePlatelet);
    EXPECT_EQ(frame.platelet.size(), 64u);
    EXPECT_TRUE(frame.velocity.empty());
    world->copyFrame(frame, kFramePlatelet);
    EXPECT_EQ(frame.attributes, std::uint32_t{kFramePlatelet});
    for (const float p : frame.platelet) EXPECT_EQ(p, present ? 0.25f : 0.0f);
    frame.reserve(64, kFrameDensity);
    EXPECT_TRUE(frame.platelet.empty());
  }
}

TEST(Platelets, AreRefusedWithWhatWouldDo) {
  const auto refused = [](const PlateletSettings& settings, const char* word) {
    WorldDescription description = test::freeBlock({4, 4, 4});
    description.effects.platelets = settings;
    const auto world = createWorld(description, {});
    ASSERT_FALSE(world.ok()) << word;
    EXPECT_EQ(world.status().code(), StatusCode::invalid_argument);
    EXPECT_NE(world.status().message().find(word), std::string::npos) << world.status().message();
  };
  refused({.fresh = 1.1}, "fresh");
  refused({.diffusivity = -1.0}, "diffusivity");
  refused({.wall_rate = std::nan("")}, "wall_rate");
  refused({.shear_gate = 0.0}, "shear_gate");
  refused({.clot_viscosity = 0.0}, "clot_viscosity");
  refused({.clot_speedup = std::numeric_limits<double>::infinity()}, "clot_speedup");
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.fluid_blocks[0].platelet = -0.1;
  EXPECT_FALSE(createWorld(description, {}).ok());
}

}  // namespace
}  // namespace bleedsim::sph
