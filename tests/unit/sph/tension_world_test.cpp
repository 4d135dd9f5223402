// Surface tension and adhesion in a world: what is conserved, what limits the step, what is refused.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "service/sph/world_setup.h"
#include "tests/support/drops.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

WorldDescription drop(double radius_in_spacings) {
  WorldDescription scene = test::emptyScene();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.surface_tension.emplace();
  test::addBall(scene, Vec3{0.0003, 0.0001, 0.0002}, radius_in_spacings * scene.spacing);
  for (FluidBlock& block : scene.fluid_blocks) block.jitter = 0.2;
  return scene;
}

// Momentum of a free body: 1e-6 of sum m |v|, physics.md section 5 case 2. In float, by 100 steps.
TEST(TensionWorld, AFreeDropKeepsItsMomentum) {
  const auto world = test::makeWorld(drop(5.0));
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(world->step(1.0).ok());
  const double size = test::momentumScaleOf(*world);
  ASSERT_GT(size, 1e-3 * world->particleMass() * world->particleCount()) << "the drop is at rest";
  EXPECT_LT(test::momentumOf(*world).norm(), 1e-6 * size);
}

TEST(TensionWorld, IsEqualForAnyNumberOfThreads) {
  const auto one = test::makeWorld(drop(9.0), {.threads = 1});
  ASSERT_GT(one->particleCount(), 2000u) << "too few particles for a second thread";
  const auto three = test::makeWorld(drop(9.0), {.threads = 3});
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(one->step(1.0).ok());
    ASSERT_TRUE(three->step(1.0).ok());
  }
  EXPECT_EQ(one->stateHash(), three->stateHash());
}

// dt <= 0.25 sqrt(rho dx^3/(2 pi sigma)): at sigma = 10 N/m it is the smallest limit, 0.4 dx/c0 being 80 us.
TEST(TensionWorld, LimitsTheStep) {
  WorldDescription scene = drop(3.0);
  EXPECT_EQ(timeStepLimits(test::freeBlock({2, 2, 2}), 5.0).capillary, std::numeric_limits<double>::infinity());
  scene.effects.surface_tension->coefficient = 10.0;
  const double limit = 0.25 * std::sqrt(1060.0 * 1e-9 / (2.0 * std::numbers::pi * 10.0));
  EXPECT_NEAR(timeStepLimits(scene, 5.0).capillary, limit, 1e-12);
  const auto world = test::makeWorld(scene);
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LE(test::statsOf(*world).dt, limit);
}

// An absent effect takes no place in the records; its arrays are members of a component that is not there.
TEST(TensionWorld, AbsentTakesNothing) {
  WorldDescription scene = drop(2.0);
  EXPECT_EQ(recordGroups(pairLayout(scene).set), 4);
  scene.effects.surface_tension.reset();
  EXPECT_EQ(recordGroups(pairLayout(scene).set), 2);
}

TEST(TensionWorld, RefusesWhatHasNoMeaning) {
  const auto refused = [](auto&& change) {
    WorldDescription scene = drop(2.0);
    scene.effects.adhesion.emplace();
    change(scene);
    return createWorld(scene, {}).status().code();
  };
  EXPECT_EQ(refused([](WorldDescription&) {}), StatusCode::ok);
  constexpr auto kInvalid = StatusCode::invalid_argument;
  EXPECT_EQ(refused([](WorldDescription& s) { s.effects.surface_tension->coefficient = -0.1; }), kInvalid);
  EXPECT_EQ(refused([](WorldDescription& s) { s.effects.surface_tension->normal_cutoff = 0.0; }), kInvalid);
  EXPECT_EQ(refused([](WorldDescription& s) { s.effects.surface_tension->contact_angle = 3.2; }), kInvalid);
  EXPECT_EQ(refused([](WorldDescription& s) { s.effects.adhesion->acceleration = std::nan(""); }), kInvalid);
  EXPECT_EQ(refused([](WorldDescription& s) { s.kernel = KernelType::cubic_spline; }), StatusCode::unsupported);
}

// a = -k f(d) n, f = 1 for d < dx, 0 at h. A lone particle without other effects: v = a dt after one step of 1 us.
TEST(Adhesion, PullsToTissueWithinTheSupportRadius) {
  const auto pull_at = [](double distance) {
    WorldDescription scene = test::emptyScene();
    scene.effects.adhesion = AdhesionSettings{7.0};
    scene.tissue.push_back({.name = "ceiling", .shape = PlaneShape{.point = Vec3::Zero(), .normal = {0.0, 0.0, -1.0}}});
    scene.max_dt = 1e-6;
    test::addParticle(scene, {0.0, 0.0, -distance});
    const auto world = test::makeWorld(scene);
    EXPECT_TRUE(world->step(1.0).ok());
    return test::velocityOf(test::frameOf(*world), 0).z() / test::statsOf(*world).dt;
  };
  EXPECT_NEAR(pull_at(0.0006), 7.0, 1e-3);
  EXPECT_NEAR(pull_at(0.00099), 7.0, 1e-3);
  EXPECT_NEAR(pull_at(0.0015), 3.5, 7e-3);
  EXPECT_NEAR(pull_at(0.0019), 0.7, 7e-3);
  EXPECT_EQ(pull_at(0.0021), 0.0);
}

}  // namespace
}  // namespace bleedsim::sph
