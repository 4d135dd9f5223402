// A pool on tissue, with a wound at its bottom, for tests of worlds that take a state over, and what such worlds are compared by.
#pragma once

#include <gtest/gtest.h>
#include <limits>

#include "tests/support/scenes.h"

namespace bleedsim::sph {

/// Blood of `depth` m on a square of 2 `half_width` m, on the tissue of test::woundOnPlane().
inline WorldDescription poolOf(double half_width, double depth, double jitter) {
  WorldDescription scene = test::woundOnPlane(0.003, 3e-6);
  FluidBlock block;
  block.lower = {-half_width, -half_width, 0.0};
  block.upper = {half_width, half_width, depth};
  block.jitter = jitter;
  scene.fluid_blocks.push_back(block);
  scene.effects.applied_force.emplace();
  return scene;
}

/// 2 mN along x, 2 mm below the surface of the pool, until that simulated time, s.
inline void stir(World& world, double until = std::numeric_limits<double>::infinity()) {
  SetForce force;
  force.key = 1;
  force.position = {0.0, 0.0, world.description().fluid_blocks.front().upper.z() - 0.002};
  force.radius = 0.003;
  force.force = {0.002, 0.0, 0.0};
  force.until = until;
  ASSERT_TRUE(world.apply(force).ok());
}

/// Ledgers, limits and counters: what a frame and a hash do not show.
inline void expectSameFigures(const World& a, const World& b) {
  const WorldStats x = test::statsOf(a);
  const WorldStats y = test::statsOf(b);
  EXPECT_EQ(x.step, y.step);
  EXPECT_EQ(x.time, y.time);
  EXPECT_EQ(x.dt, y.dt);
  EXPECT_EQ(x.particles, y.particles);
  EXPECT_EQ(x.injected, y.injected);
  EXPECT_EQ(x.removed, y.removed);
  EXPECT_EQ(x.emitted_volume, y.emitted_volume);
  EXPECT_EQ(x.commanded_volume, y.commanded_volume);
  EXPECT_EQ(x.mean_density_error, y.mean_density_error);
  EXPECT_EQ(x.max_density_error, y.max_density_error);
  EXPECT_EQ(x.max_speed, y.max_speed);
  EXPECT_EQ(x.kinetic_energy, y.kinetic_energy);
  EXPECT_EQ(x.momentum, y.momentum);
  EXPECT_EQ(x.viscosity_iterations, y.viscosity_iterations);
  EXPECT_EQ(x.counters, y.counters);
  ASSERT_EQ(a.wounds().size(), b.wounds().size());
  for (std::size_t i = 0; i < a.wounds().size(); ++i) {
    EXPECT_EQ(a.wounds()[i].id, b.wounds()[i].id);
    EXPECT_EQ(a.wounds()[i].emitted, b.wounds()[i].emitted);
    EXPECT_EQ(a.wounds()[i].flow, b.wounds()[i].flow);
    EXPECT_EQ(a.woundName(a.wounds()[i].id), b.woundName(b.wounds()[i].id));
  }
}

}  // namespace bleedsim::sph
