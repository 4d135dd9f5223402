// A pool on tissue, with a wound at its bottom, for tests of World::adopt.
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

}  // namespace bleedsim::sph
