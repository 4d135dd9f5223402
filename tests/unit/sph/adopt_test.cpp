// World::adopt: a world goes on where another one was.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "tests/unit/sph/stirred_pool.h"

namespace bleedsim::sph {
namespace {

WorldDescription pool() { return poolOf(0.012, 0.008, 0.1); }

void step(World& world, int count) {
  for (int i = 0; i < count; ++i) ASSERT_TRUE(world.step(1.0).ok());
}

class Adopt : public testing::TestWithParam<WorldOptions> {};

TEST_P(Adopt, AWorldThatTakesOverStepsOnLikeItsTwin) {
  const auto twin = test::makeWorld(pool(), GetParam());
  const auto old = test::makeWorld(pool(), GetParam());
  for (World* world : {twin.get(), old.get()}) {
    stir(*world, 0.05);
    step(*world, 30);
    UpdateWound faster;
    faster.wound_id = 1;
    faster.drive = FlowDrive{5e-6};
    ASSERT_TRUE(world->apply(faster).ok());
    step(*world, 10);
  }
  const auto heir = test::makeWorld(pool(), GetParam());
  ASSERT_TRUE(heir->adopt(*old).ok());
  EXPECT_EQ(heir->stateHash(), twin->stateHash());
  expectSameFigures(*heir, *twin);
  step(*heir, 60);
  step(*twin, 60);
  EXPECT_EQ(heir->stateHash(), twin->stateHash());
  expectSameFigures(*heir, *twin);
  RemoveWound gone;
  gone.wound_id = 1;
  ASSERT_TRUE(heir->apply(gone).ok());
  ASSERT_TRUE(twin->apply(gone).ok());
  step(*heir, 5);
  step(*twin, 5);
  EXPECT_EQ(heir->stateHash(), twin->stateHash());
  expectSameFigures(*heir, *twin);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Adopt,
                         testing::Values(WorldOptions{.threads = 1}, WorldOptions{.threads = 2},
                                         WorldOptions{.precision = Precision::float64}));

TEST(AdoptState, TheNextStepObeysTheNewLimits) {
  const auto old = test::makeWorld(pool(), {});
  step(*old, 20);
  WorldDescription thick = pool();
  thick.effects.viscosity->viscosity = 50.0;
  thick.effects.viscosity->solve = ViscositySolve::explicit_;
  const auto heir = test::makeWorld(thick, {});
  ASSERT_TRUE(heir->adopt(*old).ok());
  step(*heir, 1);
  // 0.045 h^2 rho/mu, physics.md section 2.
  const double h = thick.supportRadius();
  EXPECT_LE(test::statsOf(*heir).dt, 0.045 * h * h * thick.rest_density / 50.0 * (1.0 + 1e-12));
}

TEST(AdoptState, AnImplicitSolveEndsWhereTheNewWorldHasNone) {
  WorldDescription description = pool();
  description.effects.viscosity->solve = ViscositySolve::implicit;
  description.effects.viscosity->viscosity = 5.0;
  for (const bool viscous : {true, false}) {
    SCOPED_TRACE(viscous);
    const auto old = test::makeWorld(description, {});
    stir(*old);
    step(*old, 5);
    ASSERT_GT(test::statsOf(*old).viscosity_iterations, 0);
    WorldDescription other = description;
    other.effects.viscosity->solve = ViscositySolve::explicit_;
    if (!viscous) other.effects.viscosity.reset();
    const auto heir = test::makeWorld(other, {});
    ASSERT_TRUE(heir->adopt(*old).ok());
    step(*heir, 5);
    EXPECT_EQ(test::statsOf(*heir).viscosity_iterations, 0);
    EXPECT_FALSE(heir->faulted());
  }
}

TEST(AdoptState, BloodFollowsItsDefaultAndAFluidBlockKeepsItsOwn) {
  WorldDescription description = pool();
  FluidBlock thick;
  thick.lower = {-0.012, -0.012, 0.01};
  thick.upper = {0.012, 0.012, 0.012};
  thick.viscosity = 0.125;
  description.fluid_blocks.push_back(thick);
  const auto old = test::makeWorld(description, {});
  description.effects.viscosity->viscosity = 0.0625;
  const auto heir = test::makeWorld(description, {});
  ASSERT_TRUE(heir->adopt(*old).ok());
  const FrameBuffer frame = test::frameOf(*heir);
  std::size_t own = 0;
  for (const float viscosity : frame.viscosity) {
    if (viscosity == 0.125F) {
      ++own;
    } else {
      EXPECT_EQ(viscosity, 0.0625F);
    }
  }
  EXPECT_GT(own, 0u);
}

TEST(AdoptState, KeepsTheSpeedOfSoundItWasGiven) {
  WorldDescription weightless = pool();
  weightless.compressibility.max_fall_or_depth = 0.5;
  const auto old = test::makeWorld(weightless, {});
  weightless.effects.gravity.reset();
  EXPECT_LT(speedOfSound(weightless), old->speedOfSound());
  const auto heir = test::makeWorld(weightless, {.speed_of_sound = old->speedOfSound()});
  EXPECT_EQ(heir->speedOfSound(), old->speedOfSound());
  EXPECT_TRUE(heir->adopt(*old).ok());
  const auto other = test::makeWorld(weightless, {});
  EXPECT_EQ(other->adopt(*heir).code(), StatusCode::invalid_argument) << "another speed of sound";
}

TEST(AdoptState, RefusesAnotherBodyAndLeavesBothAsTheyAre) {
  const auto old = test::makeWorld(pool(), {});
  stir(*old);
  step(*old, 5);
  const std::uint64_t hash = old->stateHash();
  const auto refuse = [&](const std::function<void(WorldDescription&)>& change, const WorldOptions& options, StatusCode code) {
    WorldDescription other = pool();
    change(other);
    const auto heir = test::makeWorld(other, options);
    const std::uint64_t own = heir->stateHash();
    EXPECT_EQ(heir->adopt(*old).code(), code);
    EXPECT_EQ(heir->stateHash(), own);
    EXPECT_EQ(old->stateHash(), hash);
  };
  refuse([](WorldDescription& d) { d.capacity += 1; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.domain.upper.x() += 0.01; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.support_ratio = 2.5; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription&) {}, {.precision = Precision::float64}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.effects.applied_force->max_sources = 0; }, {}, StatusCode::capacity);
}

}  // namespace
}  // namespace bleedsim::sph
