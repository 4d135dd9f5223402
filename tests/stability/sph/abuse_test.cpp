// What no scene should do and every world survives: physics.md section 6 (cases 1, 3, 5, 6, 18).
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

/// A pool in a closed box, half full, that takes forces. The viscosity calms it within the half second that the cases allow.
sph::WorldDescription poolInABox() {
  sph::WorldDescription scene = closedBox({14, 14, 14});
  scene.fluid_blocks.clear();
  addBlock(scene, {0, 0, 0}, {14, 14, 7});
  scene.effects.gravity.emplace();
  scene.effects.viscosity->viscosity = 0.02;
  scene.effects.applied_force.emplace();
  scene.compressibility.max_fall_or_depth = 0.014;
  return scene;
}

sph::SetForce push(const sph::Vec3& at, const sph::Vec3& newtons) {
  sph::SetForce force;
  force.key = 1;
  force.position = at;
  force.radius = 0.003;
  force.force = newtons;
  return force;
}

class OverlapTest : public testing::TestWithParam<double> {};

// Two lattices seeded into each other, so that every particle has one at 0.1 to 0.3 dx, and a first step of a nanosecond. The
// density doubles, so p = rho0 c0^2: the worst that seeding can do. It blows apart, bounded and counted.
TEST_P(OverlapTest, isSurvived) {
  sph::WorldDescription scene = emptyScene();
  scene.tissue.push_back({.name = "plane", .shape = sph::PlaneShape{.point = {0, 0, -0.003}}});
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  addBlock(scene, {0, 0, 0}, {8, 8, 8});
  addBlock(scene, sph::Vec3::Constant(GetParam() * kSpacing / std::sqrt(3.0)), {8, 8, 8});
  const auto world = makeWorld(scene);
  ASSERT_TRUE(world->step(1e-9).ok());
  runFor(*world, 0.2);
  expectInvariants(*world);
  EXPECT_LT(statsOf(*world).mean_density_error, 0.015);
}

INSTANTIATE_TEST_SUITE_P(distances, OverlapTest, testing::Values(0.0, 0.1, 0.2, 0.3),
                         [](const auto& tested) { return "tenths" + std::to_string(std::lround(10.0 * tested.param)); });

// A push of 1 mN, then a million times that for one frame, then nothing: half a second later no clamp acts and the pool rests
// again.
TEST(Abuse, millionfoldForceForAFrame) {
  const auto world = makeWorld(poolInABox());
  const sph::Vec3 middle{0.007, 0.007, 0.004};
  ASSERT_TRUE(world->apply(push(middle, {1e-3, 0, 0})).ok());
  runFor(*world, 1.0 / 60.0);
  ASSERT_TRUE(world->apply(push(middle, {1e3, 0, 0})).ok());
  runFor(*world, 1.0 / 60.0);
  EXPECT_GT(counterOf(*world, sph::Counter::acceleration_clamped), 0u);
  expectInvariants(*world);
  ASSERT_TRUE(world->apply(sph::RemoveForce{1}).ok());
  runFor(*world, 0.45);
  const sph::WorldStats calm = statsOf(*world);
  runFor(*world, 0.05);
  const sph::WorldStats stats = statsOf(*world);
  for (const sph::Counter counter :
       {sph::Counter::acceleration_clamped, sph::Counter::speed_clamped, sph::Counter::tissue_projected}) {
    const auto index = static_cast<std::size_t>(counter);
    EXPECT_EQ(stats.counters[index], calm.counters[index]) << sph::counterName(counter);
  }
  EXPECT_LT(speedRms(*world), std::sqrt(kGravity * 0.007));
  EXPECT_LT(stats.mean_density_error, 1.5 / (10.0 * 10.0));
  EXPECT_EQ(stats.particles, 14u * 14u * 7u);
  expectInvariants(*world);
}

// A sphere of 3 mm sweeps to and fro through the pool at 10 m/s, twice the speed of sound.
TEST(Abuse, sweptSphere) {
  const auto world = makeWorld(poolInABox());
  double lowest = 1.0;
  runFor(*world, 0.05, [&] {
    const double way = std::fmod(10.0 * world->time(), 0.028);
    const bool back = way > 0.014;
    const sph::Vec3 at{back ? 0.028 - way : way, 0.007, 0.003};
    ASSERT_TRUE(world->apply(push(at, {back ? -0.05 : 0.05, 0, 0})).ok());
    lowest = std::min(lowest, lowestPhi(*world));
  });
  EXPECT_GT(lowest, -0.1);
  expectInvariants(*world);
  ASSERT_TRUE(world->apply(sph::RemoveForce{1}).ok());
  runFor(*world, 0.1);
  expectInvariants(*world);
}

TEST(Abuse, badForcesLeaveNoTrace) {
  const auto world = makeWorld(poolInABox());
  const std::uint64_t before = world->stateHash();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const sph::Vec3& newtons : {sph::Vec3{kNan, 0, 0}, sph::Vec3{0, kInfinity, 0}, sph::Vec3{1e7, 0, 0}}) {
    EXPECT_EQ(world->apply(push({0, 0, 0}, newtons)).status().code(), StatusCode::invalid_argument);
    EXPECT_EQ(world->apply(push(newtons, {kNan, 0, 0})).status().code(), StatusCode::invalid_argument);
  }
  EXPECT_EQ(world->apply(sph::RemoveForce{5}).status().code(), StatusCode::not_found);
  EXPECT_EQ(world->stateHash(), before);
}

}  // namespace
}  // namespace bleedsim::test
