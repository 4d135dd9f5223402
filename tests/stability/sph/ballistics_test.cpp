// Free flight and conservation of momentum: physics.md section 5 (case 2).
#include <cmath>
#include <gtest/gtest.h>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

sph::WorldDescription fallingScene() {
  sph::WorldDescription scene = emptyScene();
  scene.domain.lower = {-0.05, -0.05, -0.4};
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  return scene;
}

class BallisticsTest : public testing::TestWithParam<sph::Precision> {
 protected:
  static sph::WorldOptions options() { return {.precision = GetParam()}; }
  static bool isDouble() { return GetParam() == sph::Precision::float64; }
};

// z = g t^2/2, exact for kick-drift-kick under a constant acceleration; relative 2e-4 in float and 1e-9 in double. A rest lattice
// has p = 0 to the rounding of its density sums, and what is left cancels in the centre of mass.
TEST_P(BallisticsTest, blockFalls) {
  sph::WorldDescription scene = fallingScene();
  addBlock(scene, {-0.003, -0.003, -0.003}, {6, 6, 6});
  const auto world = makeWorld(scene, options());
  const double start = statsOf(*world).center.z();
  runFor(*world, 0.25);
  const double t = world->time();
  const double tolerance = isDouble() ? 1e-9 : 2e-4;
  const sph::WorldStats stats = statsOf(*world);
  EXPECT_NEAR((start - stats.center.z()) / (0.5 * kGravity * t * t), 1.0, tolerance);
  EXPECT_NEAR(-stats.momentum.z() / (216 * world->particleMass() * kGravity * t), 1.0, tolerance);
  EXPECT_EQ(stats.particles, 216u);
}

// Two blocks of different viscosity collide off centre and spin. Every pair term is antisymmetric (harmonic mean), so the sum of
// m v stays; relative to sum m |v| at the start, 1e-6 in float and 1e-10 in double.
TEST_P(BallisticsTest, spinningBlobKeepsMomentum) {
  sph::WorldDescription scene = freeBlock({8, 8, 8}, 0.1);
  scene.fluid_blocks.front().velocity = {0.3, 0.05, 0.0};
  scene.fluid_blocks.front().lower += sph::Vec3{-0.0045, -0.002, 0};
  scene.fluid_blocks.front().upper += sph::Vec3{-0.0045, -0.002, 0};
  scene.capacity = 2 * 512;
  sph::FluidBlock second = scene.fluid_blocks.front();
  second.lower += sph::Vec3{0.009, 0.004, 0};
  second.upper += sph::Vec3{0.009, 0.004, 0};
  second.velocity = {-0.2, -0.1, 0.02};
  second.viscosity = 0.05;
  scene.fluid_blocks.push_back(second);
  const auto world = makeWorld(scene, options());
  const sph::WorldStats before = statsOf(*world);
  const double scale = world->particleMass() * 512 * (sph::Vec3{0.3, 0.05, 0}.norm() + sph::Vec3{0.2, 0.1, 0.02}.norm());
  runFor(*world, 0.05);
  const sph::WorldStats after = statsOf(*world);
  EXPECT_GT(after.step, 500u);
  EXPECT_LT(after.kinetic_energy, 0.9 * before.kinetic_energy) << "the blocks must have met";
  EXPECT_LT((after.momentum - before.momentum).norm() / scale, isDouble() ? 1e-10 : 1e-6);
  expectInvariants(*world);
}

INSTANTIATE_TEST_SUITE_P(precisions, BallisticsTest, testing::Values(sph::Precision::float32, sph::Precision::float64),
                         [](const auto& tested) { return tested.param == sph::Precision::float64 ? "float64" : "float32"; });

}  // namespace
}  // namespace bleedsim::test
