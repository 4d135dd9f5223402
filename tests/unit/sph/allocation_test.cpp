// The contract of World: what runs between frames calls operator new zero times once the world is warm.
#include <gtest/gtest.h>
#include <utility>

#include "tests/support/counting_new.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

class Allocation : public testing::TestWithParam<int> {};

TEST_P(Allocation, StepFrameStatsAndHashAllocateNothing) {
  WorldDescription description = test::woundOnPlane(0.003, 3e-6);
  FluidBlock pool;
  pool.lower = {-0.01, -0.01, 0.004};
  pool.upper = {0.01, 0.01, 0.012};
  description.fluid_blocks.push_back(pool);
  description.effects.applied_force.emplace();
  description.effects.surface_tension.emplace();
  description.effects.surface_tension->contact_angle = 0.7;
  description.effects.adhesion.emplace();
  description.effects.viscosity->rheology = CassonRheology{};
  description.effects.platelets.emplace();
  const auto world = test::makeWorld(description, {.threads = GetParam()});
  SetForce force;
  force.key = 1;
  force.position = {0.0, 0.0, 0.008};
  force.radius = 0.004;
  force.force = {0.001, 0.0, 0.0};
  ASSERT_TRUE(world->apply(force).ok());
  ASSERT_GT(world->particleCount(), 2000u) << "too few particles for a second thread";

  constexpr std::uint32_t kAll = kFrameVelocity | kFrameDensity | kFrameViscosity | kFramePlatelet;
  FrameBuffer frame;
  frame.reserve(description.capacity, kAll);
  WorldStats stats;
  std::uint64_t hash = world->stateHash();
  bool stepped = true;
  bool changed = true;
  const auto turn = [&] {
    stepped = world->step(1.0).ok() && stepped;
    world->copyFrame(frame, kAll);
    world->collectStats(stats);
    const std::uint64_t last = std::exchange(hash, world->stateHash());
    changed = changed && hash != last;
  };
  for (int k = 0; k < 20; ++k) turn();
  const std::uint64_t emitted_before = stats.injected;
  const std::uint64_t before = test::allocationCount();
  for (int k = 0; k < 200; ++k) turn();
  const std::uint64_t after = test::allocationCount();

  EXPECT_EQ(after, before);
  EXPECT_TRUE(stepped);
  EXPECT_GT(stats.injected, emitted_before) << "the wound did not bleed";
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(Counter::force_without_fluid)], 0u);
  EXPECT_TRUE(changed) << "a step left the hash as it was";
}

INSTANTIATE_TEST_SUITE_P(Threads, Allocation, testing::Values(1, 2));

TEST(AllocationOfTheLiteralModel, StepAllocatesNothing) {
  WorldDescription description = test::freeBlock({8, 8, 8}, 0.2);
  description.model = Model::literal;
  description.effects.surface_tension.emplace();
  description.effects.core_radius.emplace();
  description.effects.platelets.emplace();
  description.effects.repulsion.emplace();
  const auto world = test::makeWorld(description);
  bool stepped = world->step(1.0).ok();
  const std::uint64_t before = test::allocationCount();
  for (int k = 0; k < 50; ++k) stepped = world->step(1.0).ok() && stepped;
  EXPECT_EQ(test::allocationCount(), before);
  EXPECT_TRUE(stepped);
}

TEST(AllocationOfTheRecovery, AStepThatIsTriedAgainAllocatesNothing) {
  WorldDescription description = test::woundOnPlane(0.002, 3e-6);
  description.capacity = 200;  // full soon: a throat's holes are taken back, too
  description.effects.applied_force.emplace();
  const auto world = test::makeWorld(description);
  SetForce blow;
  blow.key = 1;
  blow.position = {0.0, 0.0, 0.001};
  blow.radius = 0.004;
  bool stepped = true;
  const auto turn = [&](double newtons) {
    blow.force = {0.0, 0.0, newtons};
    stepped = world->apply(blow).ok() && stepped;
    for (int k = 0; k < 40; ++k) stepped = world->step(1.0).ok() && stepped;
  };
  for (int k = 0; k < 20; ++k) turn(0.0);
  const std::uint64_t tried_before = test::counterOf(*world, Counter::step_retried);
  const std::uint64_t before = test::allocationCount();
  for (int k = 0; k < 5; ++k) {
    turn(100.0);
    turn(0.0);
  }
  const std::uint64_t after = test::allocationCount();
  EXPECT_TRUE(stepped);
  EXPECT_EQ(after, before);
  EXPECT_GT(test::counterOf(*world, Counter::step_retried), tried_before) << "the blows must overrun a step";
  EXPECT_GT(test::counterOf(*world, Counter::emission_refused), 0u) << "the world must be full";
}

TEST(AllocationCounter, Counts) {
  const std::uint64_t before = test::allocationCount();
  FrameBuffer frame;
  frame.reserve(10, kFrameVelocity);
  EXPECT_GT(test::allocationCount(), before);
}

}  // namespace
}  // namespace bleedsim::sph
