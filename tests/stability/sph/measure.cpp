#include "tests/stability/sph/measure.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::test {
namespace {

/// The walls that push by themselves: a container has one spring for each face.
std::vector<sph::TissueShape> springsOf(const sph::WorldDescription& scene) {
  std::vector<sph::TissueShape> springs;
  for (const sph::TissueDescription& tissue : scene.tissue) {
    const auto* box = std::get_if<sph::BoxShape>(&tissue.shape);
    if (box == nullptr || box->obstacle) {
      springs.push_back(tissue.shape);
      continue;
    }
    for (const sph::PlaneShape& face : sph::containerFaces(*box)) springs.emplace_back(face);
  }
  return springs;
}

}  // namespace

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

double energyOf(const sph::World& world) {
  const sph::WorldDescription& scene = world.description();
  const sph::FrameBuffer frame = frameOf(world);
  const std::vector<sph::TissueShape> springs = springsOf(scene);
  const double c2 = world.speedOfSound() * world.speedOfSound();
  const double background = scene.effects.pressure ? scene.effects.pressure->background_pressure : 0.0;
  const bool literal = scene.model == sph::Model::literal;
  const double free_density = scene.rest_density - background / c2;
  const sph::Vec3 gravity = scene.effects.gravity ? scene.effects.gravity->acceleration : sph::Vec3::Zero();
  double sum = 0.0;  // over the mass of a particle
  for (std::size_t i = 0; i < frame.count; ++i) {
    const sph::Vec3 at = positionOf(frame, i);
    sum += 0.5 * velocityOf(frame, i).squaredNorm() - gravity.dot(at);
    const double ratio = static_cast<double>(frame.density[i]) / free_density;
    if (scene.effects.pressure && (ratio > 1.0 || literal)) sum += c2 * (std::log(ratio) + 1.0 / ratio - 1.0);
    for (const sph::TissueShape& wall : springs) {
      const double depth = std::max(0.0, 0.5 - sph::signedDistance(wall, at).value / scene.spacing);
      sum += 0.5 * c2 * depth * depth;
    }
  }
  return world.particleMass() * sum;
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

double layerMean(const sph::World& world, const sph::FrameBuffer& frame, int axis, double floor, int layer,
                 const std::function<double(std::size_t)>& value) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    if (static_cast<int>(std::floor((positionOf(frame, i)[axis] - floor) / world.description().spacing)) != layer) continue;
    sum += value(i);
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

std::vector<sph::FluidBlock> blocksWithFlow(const sph::FluidBlock& block, double spacing, int along,
                                            const std::function<sph::Vec3(const sph::Vec3&)>& field) {
  const int first = (along + 1) % 3;
  const int second = (along + 2) % 3;
  const auto count = [&](int axis) { return static_cast<int>(std::lround((block.upper[axis] - block.lower[axis]) / spacing)); };
  std::vector<sph::FluidBlock> columns;
  for (int j = 0; j < count(second); ++j) {
    for (int i = 0; i < count(first); ++i) {
      sph::FluidBlock column = block;
      column.lower[first] += i * spacing;
      column.upper[first] = column.lower[first] + spacing;
      column.lower[second] += j * spacing;
      column.upper[second] = column.lower[second] + spacing;
      column.velocity = field(0.5 * (column.lower + column.upper));
      columns.push_back(column);
    }
  }
  return columns;
}

}  // namespace bleedsim::test
