// Wounds under and beside blood and at the edge of tissue.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

double particleVolume(const sph::World& world) { return world.description().particleVolume(); }

/// The volume that came out is that of the commanded flow, to one particle for each wound.
void expectExactVolume(const sph::World& world, double wounds = 1.0) {
  const sph::WorldStats stats = statsOf(world);
  const double refused =
      static_cast<double>(stats.counters[static_cast<std::size_t>(sph::Counter::emission_refused)]) * particleVolume(world);
  EXPECT_NEAR((stats.emitted_volume + refused) / particleVolume(world), stats.commanded_volume / particleVolume(world), wounds);
}

/// A pool in an open box whose floor is z = 0, with a deep domain for throats.
sph::WorldDescription poolScene(const Counts& counts) {
  sph::WorldDescription scene = hydrostaticColumn(counts, 0.00345);
  scene.compressibility.max_fall_or_depth = 0.005;
  scene.capacity = 8000;
  scene.effects.applied_force.emplace();
  return scene;
}

// A wound opens under resting blood: its particles push in from the throat's rest positions, so nothing overlaps and nothing
// explodes. Bound: twice the faster of the column and of a fall through the pool's depth.
TEST(WoundStability, opensUnderAPool) {
  const auto world = makeWorld(poolScene({20, 20, 5}));
  runFor(*world, 0.05);
  sph::WoundDescription wound = discWound(0.003, 2.5e-6);
  wound.position = {0.01, 0.01, 0.0};
  const auto added = world->apply(sph::AddWound{wound});
  ASSERT_TRUE(added.ok()) << added.status().message();
  const double column = 2.5e-6 / (std::acos(-1.0) * 0.003 * 0.003);
  const double fall = std::sqrt(2.0 * kGravity * 0.005);
  double fastest = 0.0;
  double lowest = 1.0;
  runFor(*world, 0.4, [&] {
    fastest = std::max(fastest, statsOf(*world).max_speed);
    if (world->stepCount() % 10 == 0) lowest = std::min(lowest, lowestPhi(*world));
  });
  const sph::WorldStats stats = statsOf(*world);
  RecordProperty("fastest_m_per_s", std::to_string(fastest));
  EXPECT_LT(fastest, 2.0 * std::max(column, fall));
  EXPECT_GT(lowest, -0.1);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(sph::Counter::speed_clamped)], 0u);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(sph::Counter::acceleration_clamped)], 0u);
  EXPECT_NEAR(stats.commanded_volume, 2.5e-6 * 0.4, 2.5e-6 * 0.001);
  expectExactVolume(*world);
  expectInvariants(*world);
}

// The wound's rim touches the foot of a side wall, so half of its surroundings is tissue that stays closed.
TEST(WoundStability, opensAtTheFootOfAWall) {
  sph::WorldDescription scene = poolScene({20, 20, 5});
  sph::WoundDescription wound = discWound(0.002, 1e-6);
  wound.position = {0.0025, 0.01, 0.0};
  scene.wounds.push_back(wound);
  const auto world = makeWorld(scene);
  double lowest = 1.0;
  runFor(*world, 0.4, [&] {
    if (world->stepCount() % 10 == 0) lowest = std::min(lowest, lowestPhi(*world));
  });
  EXPECT_GT(lowest, -0.1);
  EXPECT_LT(statsOf(*world).max_speed, 2.0 * std::sqrt(2.0 * kGravity * 0.005));
  EXPECT_EQ(counterOf(*world, sph::Counter::acceleration_clamped), 0u);
  expectExactVolume(*world);
  expectInvariants(*world);
}

// The shipped coarse scene in miniature: 3 mm spacing, a 3 mm disc at 1.5 mL/s, a second wound at 2 mL/s after a second, 5 s in
// all.
TEST(WoundStability, roundWoundForFiveSeconds) {
  sph::WorldDescription scene = woundOnPlane(0.003, 1.5e-6);
  scene.spacing = 0.003;
  scene.compressibility.design_speed = 0.3;
  scene.compressibility.max_fall_or_depth = 0.004;
  scene.domain.lower = {-0.06, -0.06, -0.012};
  scene.domain.upper = {0.06, 0.06, 0.06};
  const auto world = makeWorld(scene);
  double lowest = 1.0;
  const auto watch = [&] {
    if (world->stepCount() % 50 == 0) lowest = std::min(lowest, lowestPhi(*world));
  };
  runFor(*world, 1.0, watch);
  sph::WoundDescription second = discWound(0.003, 2e-6);
  second.position = {0.02, 0.01, 0.0};
  ASSERT_TRUE(world->apply(sph::AddWound{second}).ok());
  runFor(*world, 4.0, watch);
  const sph::WorldStats stats = statsOf(*world);
  EXPECT_NEAR(stats.commanded_volume, 1.5e-6 * 5.0 + 2e-6 * 4.0, 1e-8);
  expectExactVolume(*world, 2.0);
  // A sheet of one particle meets little friction at this spacing, so some of it slides off the sides; nothing else is removed.
  EXPECT_EQ(stats.removed, stats.counters[static_cast<std::size_t>(sph::Counter::left_domain)]);
  EXPECT_GT(stats.particles, stats.injected / 2);
  EXPECT_GT(lowest, -0.1);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(sph::Counter::tissue_projected)], 0u);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(sph::Counter::speed_clamped)], 0u);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(sph::Counter::acceleration_clamped)], 0u);
  expectInvariants(*world);
}

}  // namespace
}  // namespace bleedsim::test
