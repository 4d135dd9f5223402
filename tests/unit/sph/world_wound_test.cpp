// Wounds of a running world: identities, refusals, and a ledger that accounts for every particle at every step.
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <vector>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kMlPerSecond = 1e-6;
constexpr double kPascalPerMmHg = 133.322;

void expectLedger(const World& world) {
  const WorldStats stats = test::statsOf(world);
  ASSERT_EQ(stats.injected - stats.removed, stats.particles) << "step " << stats.step;
  ASSERT_EQ(stats.particles, world.particleCount());
}

/// Steps until `time` and holds, at every step, particles to the ledger and the emitted volume to within one particle of the
/// commanded one.
void bleedUntil(World& world, double time) {
  const double volume = world.description().particleVolume();
  while (world.time() < time) {
    ASSERT_TRUE(world.step(1.0).ok());
    ASSERT_NO_FATAL_FAILURE(expectLedger(world));
    const WorldStats stats = test::statsOf(world);
    const double owed = (stats.commanded_volume - stats.emitted_volume) / volume;
    ASSERT_GT(owed, -1e-6) << "emitted more than was due";
    ASSERT_LT(owed, 1.0 + 1e-6);
  }
}

UpdateWound withDrive(std::uint32_t id, const WoundDrive& drive) {
  UpdateWound update;
  update.wound_id = id;
  update.drive = drive;
  return update;
}

TEST(WorldWounds, ACheckAnswersAsTheCommandWouldAndChangesNothing) {
  const auto world = test::makeWorld(test::woundOnPlane(0.002, 1e-6));
  ASSERT_TRUE(world->step(1.0).ok());
  const std::uint64_t before = world->stateHash();
  AddWound over{world->description().wounds[0]};
  AddWound beside = over;
  beside.wound.position.x() += 0.01;
  UpdateWound elsewhere;
  elsewhere.wound_id = 1;
  elsewhere.position = beside.wound.position;
  const UpdateWound unknown = withDrive(7, FlowDrive{1e-6});
  const std::vector<Command> commands{over, unknown, RemoveWound{7}, beside, elsewhere, RemoveWound{1}};
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Status told = world->checkWound(commands[i]);
    EXPECT_EQ(told.ok(), i >= 3) << i << ": " << told.message();
  }
  EXPECT_EQ(world->wounds().size(), 1u);
  EXPECT_EQ(world->stateHash(), before);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(world->apply(commands[i]).status().message(), world->checkWound(commands[i]).message());
  }
}

TEST(WorldWounds, IdsRiseAndAreNeverReused) {
  const auto world = test::makeWorld(test::woundOnPlane(0.002, 1e-6));
  ASSERT_EQ(world->wounds().size(), 1u);
  EXPECT_EQ(world->wounds()[0].id, 1u);
  WoundDescription second = test::discWound(0.002, 2e-6);
  second.position.x() = 0.01;
  const auto added = world->apply(AddWound{second});
  ASSERT_TRUE(added.ok()) << added.status().message();
  EXPECT_EQ(added->object_id, 2u);
  ASSERT_TRUE(world->apply(RemoveWound{2}).ok());
  EXPECT_EQ(world->wounds().size(), 1u);
  const auto again = world->apply(AddWound{second});
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->object_id, 3u);
  const auto updated = world->apply(withDrive(3, FlowDrive{3e-6}));
  ASSERT_TRUE(updated.ok());
  EXPECT_EQ(updated->object_id, 3u);
  ASSERT_EQ(world->wounds().size(), 2u);
  EXPECT_EQ(world->wounds()[1].id, 3u);
  EXPECT_DOUBLE_EQ(world->wounds()[1].flow, 3e-6);
}

TEST(WorldWounds, VolumeIsTheIntegralOfAChangingFlow) {
  const auto world = test::makeWorld(test::woundOnPlane(0.003, 4 * kMlPerSecond));
  double expected = 0.0;
  double now = 0.0;
  double flow = 4 * kMlPerSecond;
  for (const double next : {8 * kMlPerSecond, 0.0, 1 * kMlPerSecond, 6 * kMlPerSecond, 0.0}) {
    ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, now + 0.01));
    expected += flow * (world->time() - now);
    now = world->time();
    const WorldStats stats = test::statsOf(*world);
    EXPECT_NEAR(stats.commanded_volume, expected, 1e-9 * expected);
    EXPECT_NEAR(stats.emitted_volume, expected, world->description().particleVolume() * (1.0 + 1e-6));
    EXPECT_DOUBLE_EQ(stats.emitted_volume, static_cast<double>(stats.injected) * world->description().particleVolume());
    EXPECT_DOUBLE_EQ(world->wounds()[0].emitted, stats.emitted_volume);
    ASSERT_TRUE(world->apply(withDrive(1, FlowDrive{next})).ok());
    EXPECT_DOUBLE_EQ(world->wounds()[0].flow, next);
    flow = next;
  }
  EXPECT_GT(test::statsOf(*world).injected, 100u);
}

TEST(WorldWounds, InletPressureStepsFollowTheOrificeLaw) {
  WorldDescription description = test::woundOnPlane(0.002, 0.0);
  constexpr double kPressure = 120 * kPascalPerMmHg;
  description.wounds[0].drive = PressureDriveSettings{kPressure, 0.61};
  const auto world = test::makeWorld(description);
  const double speed = 0.61 * std::sqrt(2.0 * kPressure / test::kRestDensity);
  const double flow = speed * std::numbers::pi * 0.002 * 0.002;
  EXPECT_NEAR(world->wounds()[0].flow, flow, 1e-9 * flow);
  EXPECT_NEAR(world->speedOfSound(), 10.0 * std::sqrt(2.0 * kPressure / test::kRestDensity), 1e-9 * world->speedOfSound());
  double open = 0.0;
  for (int turn = 0; turn < 5; ++turn) {
    const bool pressed = turn % 2 == 0;
    const double before = world->time();
    ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, before + 0.002));
    if (pressed) open += world->time() - before;
    EXPECT_NEAR(test::statsOf(*world).emitted_volume, flow * open, world->description().particleVolume() * (1.0 + 1e-6));
    ASSERT_TRUE(world->apply(withDrive(1, PressureDriveSettings{pressed ? 0.0 : kPressure, 0.61})).ok());
    EXPECT_NEAR(world->wounds()[0].flow, pressed ? 0.0 : flow, 1e-9 * flow);
  }
  EXPECT_GT(test::statsOf(*world).injected, 50u);
}

TEST(WorldWounds, RemovalKeepsWhatBledAndTakesBackTheUnseen) {
  const auto world = test::makeWorld(test::woundOnPlane(0.003, 6 * kMlPerSecond));
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.02));
  const WorldStats before = test::statsOf(*world);
  ASSERT_GT(before.particles, 100u);
  const FrameBuffer seen = test::frameOf(*world);
  ASSERT_TRUE(world->apply(RemoveWound{1}).ok());
  EXPECT_TRUE(world->wounds().empty());
  EXPECT_EQ(world->particleCount(), before.particles);
  EXPECT_EQ(test::frameOf(*world).id, seen.id);
  EXPECT_GT(test::counterOf(*world, Counter::inlet_withdrawn), 0u);
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.03));
  const WorldStats after = test::statsOf(*world);
  EXPECT_EQ(after.injected, before.injected);
  EXPECT_DOUBLE_EQ(after.emitted_volume, before.emitted_volume);
  EXPECT_DOUBLE_EQ(after.commanded_volume, before.commanded_volume);
}

TEST(WorldWounds, MovingReshapingAndTurningKeepsTheLedger) {
  const auto world = test::makeWorld(test::woundOnPlane(0.003, 6 * kMlPerSecond));
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.005));
  UpdateWound move;
  move.wound_id = 1;
  move.position = Vec3{0.004, 0.001, 0.0};
  ASSERT_TRUE(world->apply(move).ok());
  ASSERT_NO_FATAL_FAILURE(expectLedger(*world));
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.01));
  UpdateWound reshape;
  reshape.wound_id = 1;
  reshape.shape = EllipsePatch{0.004, 0.002};
  reshape.tangent = Vec3{0.0, 1.0, 0.0};
  ASSERT_TRUE(world->apply(reshape).ok());
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.015));
  UpdateWound slit;
  slit.wound_id = 1;
  slit.shape = PolylinePatch{{{-0.006, 0.0}, {0.0, 0.002}, {0.006, 0.0}}, 0.0021};
  slit.normal = Vec3{0.0, 0.07, 1.0}.normalized();
  slit.name = "slit";
  const auto applied = world->apply(slit);
  ASSERT_TRUE(applied.ok()) << applied.status().message();
  ASSERT_NO_FATAL_FAILURE(bleedUntil(*world, 0.02));
  EXPECT_NEAR(test::statsOf(*world).emitted_volume, 6 * kMlPerSecond * world->time(),
              world->description().particleVolume() * (1.0 + 1e-6));
  EXPECT_EQ(test::counterOf(*world, Counter::emission_refused), 0u);
}

TEST(WorldWounds, EmissionBeyondTheCapacityIsRefusedAndCounted) {
  WorldDescription description = test::woundOnPlane(0.003, 6 * kMlPerSecond);
  description.capacity = 150;
  const auto world = test::makeWorld(description);
  while (world->time() < 0.06) {
    ASSERT_TRUE(world->step(1.0).ok());
    ASSERT_NO_FATAL_FAILURE(expectLedger(*world));
    ASSERT_LE(world->particleCount(), 150u);
  }
  const WorldStats stats = test::statsOf(*world);
  const std::uint64_t refused = stats.counters[static_cast<std::size_t>(Counter::emission_refused)];
  EXPECT_GT(refused, 100u);
  EXPECT_EQ(stats.removed, 0u);
  const auto due = static_cast<double>(stats.injected + refused) * description.particleVolume();
  EXPECT_NEAR(due, stats.commanded_volume, description.particleVolume() * (1.0 + 1e-6)) << "each due particle is one of the two";
}

TEST(WorldWounds, FramesShowTheEmittedOnlyAndIdsStay) {
  const auto world = test::makeWorld(test::woundOnPlane(0.003, 6 * kMlPerSecond));
  std::map<std::uint32_t, Vec3> known;
  for (int k = 0; k < 400; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    const FrameBuffer frame = test::frameOf(*world);
    ASSERT_EQ(frame.count, world->particleCount());
    ASSERT_EQ(frame.step, world->stepCount());
    ASSERT_DOUBLE_EQ(frame.time, world->time());
    const WorldStats stats = test::statsOf(*world);
    const double farthest = 2.0 * stats.max_speed * stats.dt + 0.1 * test::kSpacing;
    std::map<std::uint32_t, Vec3> now;
    for (std::size_t i = 0; i < frame.count; ++i) {
      const Vec3 position = test::positionOf(frame, i);
      ASSERT_GT(position.z(), -1e-4) << "a throat's particle shows";
      ASSERT_TRUE(now.emplace(frame.id[i], position).second) << "two particles share an id";
      const auto before = known.find(frame.id[i]);
      if (before != known.end()) { ASSERT_LT((position - before->second).norm(), farthest) << "the id went to another particle"; }
    }
    ASSERT_EQ(stats.removed, 0u);
    for (const auto& [id, position] : known) ASSERT_EQ(now.count(id), 1u) << "id " << id << " vanished";
    known = std::move(now);
  }
  EXPECT_GT(known.size(), 50u);
}

TEST(WorldWounds, TheirNumberIsBounded) {
  WorldDescription description = test::woundOnPlane(0.002, 1e-6);
  description.max_wounds = 2;
  const auto world = test::makeWorld(description);
  WoundDescription next = test::discWound(0.002, 1e-6);
  next.position.x() = 0.01;
  ASSERT_TRUE(world->apply(AddWound{next}).ok());
  next.position.x() = 0.02;
  const auto refused = world->apply(AddWound{next});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.status().code(), StatusCode::capacity);
}

}  // namespace
}  // namespace bleedsim::sph
