// World::step and what a world reports: limits, particles that leave, frames, statistics.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(WorldStep, AnImpossibleLimitIsRefusedAndChangesNothing) {
  const auto world = test::makeWorld(test::freeBlock({5, 5, 5}, 0.2));
  ASSERT_TRUE(world->step(1.0).ok());
  const std::uint64_t hash = world->stateHash();
  for (const double limit : {0.0, -0.0, -1e-4, -kInfinity, kNan}) {
    const Status status = world->step(limit);
    EXPECT_EQ(status.code(), StatusCode::invalid_argument) << limit;
    EXPECT_NE(status.message().find("greater than 0"), std::string::npos);
  }
  EXPECT_EQ(world->stateHash(), hash);
  EXPECT_EQ(world->stepCount(), 1u);
  EXPECT_FALSE(world->faulted());
  EXPECT_TRUE(world->step(1.0).ok());
}

TEST(WorldStep, TakesTheStableTimeUnlessTheLimitIsShorter) {
  const auto world = test::makeWorld(test::freeBlock({6, 6, 6}));
  const double acoustic = 0.4 * test::kSpacing / world->speedOfSound();
  for (const double limit : {1.0, kInfinity}) {
    const double before = world->time();
    ASSERT_TRUE(world->step(limit).ok());
    const double dt = test::statsOf(*world).dt;
    EXPECT_DOUBLE_EQ(world->time(), before + dt);
    EXPECT_LE(dt, acoustic);
    EXPECT_GT(dt, 0.9 * acoustic) << "a block at rest is bound by sound alone";
  }
  const double stable = test::statsOf(*world).dt;
  ASSERT_TRUE(world->step(1e-9).ok());
  EXPECT_DOUBLE_EQ(test::statsOf(*world).dt, 1e-9);
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_GT(test::statsOf(*world).dt, 0.9 * stable) << "a short step asked for does not shorten those after it";
  EXPECT_EQ(world->stepCount(), 4u);
}

TEST(WorldStep, MaxDtOfTheSceneBinds) {
  WorldDescription description = test::freeBlock({5, 5, 5});
  description.max_dt = 2e-6;
  const auto world = test::makeWorld(description);
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    EXPECT_DOUBLE_EQ(test::statsOf(*world).dt, 2e-6);
  }
}

TEST(WorldStep, AnEmptyWorldAdvances) {
  const auto world = test::makeWorld(test::emptyScene());
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(world->particleCount(), 0u);
  const WorldStats stats = test::statsOf(*world);
  EXPECT_GT(stats.dt, 0.0);
  EXPECT_NEAR(world->time(), 3.0 * stats.dt, 1e-12 * stats.dt) << "nothing changes the step of an empty world";
  EXPECT_EQ(world->stepCount(), 3u);
  EXPECT_EQ(stats.center, Vec3::Zero());
  EXPECT_EQ(stats.mean_density_error, 0.0);
}

TEST(WorldStep, ParticlesThatLeaveTheDomainAreRemovedAndCounted) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.effects = {};
  description.domain.upper.x() = 0.003;
  description.fluid_blocks[0].velocity = {0.4, 0.0, 0.0};
  const auto world = test::makeWorld(description);
  std::uint32_t before = 64;
  while (world->time() < 0.02) {
    ASSERT_TRUE(world->step(1.0).ok());
    ASSERT_LE(world->particleCount(), before);
    before = world->particleCount();
    const WorldStats stats = test::statsOf(*world);
    ASSERT_EQ(stats.injected, 64u);
    ASSERT_EQ(stats.injected - stats.removed, stats.particles);
    ASSERT_EQ(stats.counters[static_cast<std::size_t>(Counter::left_domain)], stats.removed);
    const FrameBuffer frame = test::frameOf(*world);
    for (std::size_t i = 0; i < frame.count; ++i) ASSERT_LE(test::positionOf(frame, i).x(), 0.003 * (1.0 + 1e-6));
  }
  EXPECT_EQ(world->particleCount(), 0u) << "all fly out in 13 ms";
}

TEST(WorldStep, PeriodicSidesKeepEveryParticle) {
  WorldDescription description = test::periodicBox({8, 8, 8});
  description.effects = {};
  description.fluid_blocks[0].velocity = {0.4, -0.3, 0.2};
  const auto world = test::makeWorld(description);
  while (world->time() < 0.05) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(world->particleCount(), 512u);
  EXPECT_EQ(test::counterOf(*world, Counter::left_domain), 0u);
  const FrameBuffer frame = test::frameOf(*world);
  for (std::size_t i = 0; i < frame.count; ++i) {
    const Vec3 position = test::positionOf(frame, i);
    ASSERT_GE(position.minCoeff(), -1e-8);
    ASSERT_LE(position.maxCoeff(), 0.008 + 1e-8);
  }
}

TEST(WorldStep, GravityAloneIsFreeFall) {
  WorldDescription description = test::freeBlock({3, 3, 3});
  description.effects = {};
  description.effects.gravity.emplace();
  const auto world = test::makeWorld(description, {.precision = Precision::float64});
  while (world->time() < 0.05) ASSERT_TRUE(world->step(1.0).ok());
  const double t = world->time();
  const WorldStats stats = test::statsOf(*world);
  EXPECT_NEAR(stats.center.z(), -0.5 * test::kGravity * t * t, 1e-9);
  EXPECT_NEAR(stats.momentum.z(), -27.0 * world->particleMass() * test::kGravity * t, 1e-9 * stats.momentum.norm());
  EXPECT_NEAR(stats.max_speed, test::kGravity * t, 1e-9);
}

TEST(WorldFrame, HoldsTheAttributesAskedFor) {
  WorldDescription description = test::freeBlock({6, 4, 4}, 0.1);
  FluidBlock thick = description.fluid_blocks[0];
  thick.lower.x() += 0.02;
  thick.upper.x() += 0.02;
  thick.viscosity = 0.05;
  description.fluid_blocks.push_back(thick);
  description.capacity = 200;
  const auto world = test::makeWorld(description);
  const FrameBuffer whole = test::frameOf(*world);
  ASSERT_EQ(whole.count, 192u);
  EXPECT_EQ(whole.attributes, kFrameVelocity | kFrameDensity | kFrameViscosity | kFramePlatelet | kFrameRadius);
  for (std::size_t i = 0; i < whole.count; ++i) {
    EXPECT_NEAR(whole.viscosity[i], test::positionOf(whole, i).x() > 0.01 ? 0.05 : 0.00345, 1e-8);
    EXPECT_GT(whole.density[i], 100.0f);
    EXPECT_LT(whole.density[i], 2000.0f);
  }
  for (const std::uint32_t attributes : {std::uint32_t{0}, std::uint32_t{kFrameVelocity}, std::uint32_t{kFrameDensity}}) {
    FrameBuffer frame;
    frame.reserve(description.capacity, attributes);
    EXPECT_EQ(frame.velocity.size(), attributes & kFrameVelocity ? 600u : 0u);
    EXPECT_EQ(frame.density.size(), attributes & kFrameDensity ? 200u : 0u);
    EXPECT_TRUE(frame.viscosity.empty());
    world->copyFrame(frame, attributes);
    EXPECT_EQ(frame.attributes, attributes);
    ASSERT_EQ(frame.count, whole.count);
    EXPECT_TRUE(std::equal(whole.position.begin(), whole.position.end(), frame.position.begin()));
    EXPECT_TRUE(std::equal(whole.id.begin(), whole.id.end(), frame.id.begin()));
  }
}

TEST(WorldStats, AreThoseOfTheFrame) {
  WorldDescription description = test::closedBox({7, 6, 5}, 0.2);
  const auto world = test::makeWorld(description, {.precision = Precision::float64});
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(world->step(1.0).ok());
  const WorldStats stats = test::statsOf(*world);
  const FrameBuffer frame = test::frameOf(*world);
  double energy = 0.0;
  double error = 0.0;
  double fastest = 0.0;
  Vec3 center = Vec3::Zero();
  for (std::size_t i = 0; i < frame.count; ++i) {
    energy += 0.5 * world->particleMass() * test::velocityOf(frame, i).squaredNorm();
    error += std::max(0.0, static_cast<double>(frame.density[i]) / test::kRestDensity - 1.0) / frame.count;
    fastest = std::max(fastest, test::velocityOf(frame, i).norm());
    center += test::positionOf(frame, i) / frame.count;
  }
  EXPECT_GT(energy, 0.0);
  EXPECT_NEAR(stats.kinetic_energy, energy, 1e-5 * energy);
  EXPECT_NEAR(stats.mean_density_error, error, 1e-5);
  EXPECT_NEAR(stats.max_speed, fastest, 1e-5 * fastest);
  EXPECT_LT((stats.center - center).norm(), 1e-8);
  EXPECT_LT((stats.momentum - test::momentumOf(*world)).norm(), 1e-9);
  EXPECT_EQ(stats.step, 20u);
  EXPECT_EQ(stats.injected, 210u);
}

// Stages are timed from creation on, not from whenever the machine was started.
TEST(WorldStages, TimeIsThatOfThisWorld) {
  const auto world = test::makeWorld(test::freeBlock({4, 4, 4}));
  ASSERT_TRUE(world->step(1.0).ok());
  double sum = 0.0;
  for (const double seconds : test::statsOf(*world).stage_seconds) sum += seconds;
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(sum, 600.0);
}

TEST(WorldNames, EveryStageAndCounterHasItsOwn) {
  std::vector<std::string_view> names;
  for (int s = 0; s < static_cast<int>(Stage::count); ++s) names.push_back(stageName(static_cast<Stage>(s)));
  for (int c = 0; c < static_cast<int>(Counter::count); ++c) names.push_back(counterName(static_cast<Counter>(c)));
  EXPECT_EQ(std::count(names.begin(), names.end(), std::string_view{}), 0);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(counterName(Counter::force_expired), "force_expired");
  EXPECT_EQ(stageName(Stage::integrate), "integrate");
}

}  // namespace
}  // namespace bleedsim::sph
