#include "tests/stability/sph/measure.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::test {

void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts, const sph::Vec3& velocity) {
  sph::FluidBlock block;
  block.lower = lower;
  block.upper = lower + scene.spacing * sph::Vec3{double(counts[0]), double(counts[1]), double(counts[2])};
  block.velocity = velocity;
  scene.fluid_blocks.push_back(block);
}

void runFor(sph::World& world, double seconds, const std::function<void()>& each) {
  const double end = world.time() + seconds;
  while (world.time() < end) {
    const Status status = world.step(std::numeric_limits<double>::infinity());
    ASSERT_TRUE(status.ok()) << status.message() << " at " << world.time() << " s";
    each();
  }
}

double speedRms(const sph::World& world) {
  const sph::WorldStats stats = statsOf(world);
  return stats.particles == 0 ? 0.0 : std::sqrt(2.0 * stats.kinetic_energy / (world.particleMass() * stats.particles));
}

double lowestPhi(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < frame.count; ++i) {
    for (const sph::TissueDescription& tissue : world.description().tissue) {
      lowest = std::min(lowest, sph::signedDistance(tissue.shape, positionOf(frame, i)).value);
    }
  }
  return lowest / world.description().spacing;
}

void expectInvariants(const sph::World& world) {
  const sph::WorldStats stats = statsOf(world);
  const sph::FrameBuffer frame = frameOf(world);
  EXPECT_FALSE(world.faulted());
  EXPECT_EQ(stats.particles, stats.injected - stats.removed);
  EXPECT_EQ(frame.count, stats.particles);
  std::size_t infinite = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    if (!positionOf(frame, i).allFinite() || !velocityOf(frame, i).allFinite() || !std::isfinite(frame.density[i])) ++infinite;
  }
  EXPECT_EQ(infinite, 0u);
  EXPECT_LE(stats.max_speed, 2.0 * world.speedOfSound() * (1.0 + 1e-6));
  EXPECT_GE(lowestPhi(world), -0.1);
}

}  // namespace bleedsim::test
