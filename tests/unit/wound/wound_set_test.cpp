#include "service/sph/wound/wound_set.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/unit/wound/throat_world.h"

namespace bleedsim::sph {
namespace {

constexpr double kDx = 0.001;
constexpr double kVolume = kDx * kDx * kDx;

WoundDescription discAt(const Vec3& position, double radius, double flow) {
  WoundDescription wound = discWound(radius, flow);
  wound.position = position;
  return wound;
}

TEST(WoundSet, IdsRiseAndAreNeverReused) {
  ThroatWorld world{plainDescription()};
  for (std::uint32_t id = 1; id <= 5; ++id) {
    const auto added = world.set.add(discAt({0.01 * id - 0.03, 0, 0}, 0.002, 1e-6));
    ASSERT_TRUE(added.ok()) << added.status().message();
    EXPECT_EQ(*added, id);
  }
  ASSERT_TRUE(world.set.remove(5, world.withdrawing()).ok());
  ASSERT_TRUE(world.set.remove(2, world.withdrawing()).ok());
  const auto next = world.set.add(discAt({0.02, 0, 0}, 0.002, 1e-6));
  ASSERT_TRUE(next.ok());
  EXPECT_EQ(*next, 6u);
  ASSERT_EQ(world.set.states().size(), 4u);
  EXPECT_EQ(world.set.states()[1].id, 3u);
  EXPECT_EQ(world.set.states()[3].id, 6u);
  world.step(1e-3);
  for (const auto& [tag, state] : world.tagged) {
    EXPECT_TRUE(state.position.allFinite());
    EXPECT_NE(unpackInletTag(tag).slot, 0u);
  }
  EXPECT_GE(world.nearestPair(), 0.999 * kDx);
}

TEST(WoundSet, RemovalWithdrawsTheUnseenAndFreesTheEmerging) {
  ThroatWorld world{plainDescription()};
  ASSERT_TRUE(world.set.add(discWound(0.003, 5e-6)).ok());
  for (int step = 0; step < 777; ++step) world.step(1e-4);
  const std::uint64_t unseen = world.set.throat(1)->unseen();
  const std::uint64_t tagged = world.tagged.size();
  const std::uint64_t released = world.released;
  const double emitted = world.set.emittedVolume();
  ASSERT_GT(tagged, unseen);
  ASSERT_TRUE(world.set.remove(1, world.withdrawing()).ok());
  EXPECT_EQ(world.withdrawn, unseen);
  EXPECT_EQ(world.set.withdrawnParticles(), unseen);
  EXPECT_EQ(world.released - released, tagged - unseen);
  EXPECT_EQ(world.released, world.set.emittedParticles());
  EXPECT_TRUE(world.tagged.empty());
  EXPECT_TRUE(world.set.empty());
  world.step(1e-4);
  EXPECT_EQ(world.set.emittedVolume(), emitted);
  EXPECT_NEAR(world.set.commandedVolume(), 777 * 1e-4 * 5e-6, 1e-15);
  EXPECT_NEAR(emitted, world.set.commandedVolume(), kVolume);
}

TEST(WoundSet, MovingAndReshapingKeepsTheVolumeExact) {
  ThroatWorld world{plainDescription()};
  ASSERT_TRUE(world.set.add(discWound(0.003, 5e-6)).ok());
  double commanded = 0.0;
  for (int step = 0; step < 2000; ++step) {
    if (step % 13 == 5) {
      UpdateWound change = moveChange(1, Vec3{0.01 * std::sin(step), 0.01 * std::cos(step), 0.0});
      if (step % 3 == 0) change.shape = EllipsePatch{0.002 + 1e-6 * step, 0.003};
      if (step % 5 == 0) change.normal = Vec3{std::sin(step), 0, 1.5};
      const Status changed = world.set.update(change, world.withdrawing());
      ASSERT_TRUE(changed.ok()) << changed.message();
      EXPECT_TRUE(world.tagged.empty());
    }
    world.step(1e-4);
    commanded += 5e-6 * 1e-4;
    ASSERT_NEAR(world.set.emittedVolume(), commanded, kVolume * (1 + 1e-9));
    ASSERT_EQ(world.set.states()[0].emitted, world.set.emittedVolume());
  }
  EXPECT_GT(world.set.withdrawnParticles(), 1000u);
  EXPECT_EQ(world.set.withdrawnParticles(), world.withdrawn);
  EXPECT_EQ(world.seen_crossing, world.emitted);
}

/// The smallest distance, in spacings, between what a move by `shift` spacings set free and the throat that opened after it.
double clearanceAfterMove(double shift) {
  double nearest = 1e9;
  ThroatWorld world{plainDescription()};
  EXPECT_TRUE(world.set.add(discWound(0.004, 8e-6)).ok());
  Vec3 position = Vec3::Zero();
  for (int step = 1; step < 2000; ++step) {
    world.step(1e-4);
    if (step % 40 != 0) continue;
    world.freed.clear();
    position.x() += step % 800 < 400 ? shift * kDx : -shift * kDx;
    UpdateWound change = moveChange(1, position);
    change.shape = DiscPatch{0.004};
    EXPECT_TRUE(world.set.update(change, world.withdrawing()).ok());
    EXPECT_FALSE(world.freed.empty());
    world.step(0.0);
    for (const Vec3& freed : world.freed) {
      for (const auto& [tag, state] : world.tagged) nearest = std::min(nearest, (state.position - freed).norm() / kDx);
    }
  }
  return nearest;
}

TEST(WoundSet, ReopeningKeepsClearOfWhatWasJustEmitted) {
  EXPECT_GE(clearanceAfterMove(0.0), 0.98);
  for (const double shift : {0.1, 0.25, 0.5, 0.75, 1.0}) EXPECT_GE(clearanceAfterMove(shift), 0.85) << shift;
}

TEST(WoundSet, FlowAndNameChangeInPlace) {
  ThroatWorld world{plainDescription()};
  ASSERT_TRUE(world.set.add(discWound(0.003, 5e-6)).ok());
  world.step(1e-3);
  const auto before = world.tagged;
  UpdateWound change = driveChange(1, FlowDrive{1e-6});
  change.name = "lateral";
  ASSERT_TRUE(world.set.update(change, world.withdrawing()).ok());
  EXPECT_EQ(world.set.description(1)->name, "lateral");
  EXPECT_EQ(world.set.states()[0].flow, 1e-6);
  EXPECT_EQ(world.withdrawn, 0u);
  for (const auto& [tag, state] : before) EXPECT_EQ(world.set.kinematics(tag).position, state.position);
}

TEST(WoundSet, InletPressureStepsKeepTheVolume) {
  WorldDescription description = plainDescription();
  description.compressibility.design_speed = 6.0;
  ThroatWorld world{description};
  ASSERT_TRUE(world.set.add(discWound(0.002, 0.0)).ok());
  const double full = 120.0 * 133.322;
  const double flow = 0.61 * std::sqrt(2.0 * full / 1060.0) * patchArea(DiscPatch{0.002});
  double commanded = 0.0;
  for (int step = 0; step < 2000; ++step) {
    const bool on = step / 100 % 2 == 1;
    ASSERT_TRUE(world.set.update(driveChange(1, PressureDriveSettings{on ? full : 0.0, 0.61}), {}).ok());
    world.step(1e-5);
    commanded += on ? flow * 1e-5 : 0.0;
    ASSERT_NEAR(world.set.emittedVolume(), commanded, kVolume * (1 + 1e-6));
  }
  EXPECT_GT(world.emitted, 100u);
}

TEST(WoundSet, PeriodicSidesWrapTheThroatAndItsOpening) {
  WorldDescription description = plainDescription();
  description.domain.lower = {-0.01, -0.01, -0.01};
  description.domain.upper = {0.01, 0.01, 0.02};
  description.domain.periodic = {true, false, false};
  ThroatWorld world{description};
  ASSERT_TRUE(world.set.add(discAt({0.0099, 0, 0}, 0.004, 1e-6)).ok());
  world.step(0.0);
  int wrapped = 0;
  for (const auto& [tag, state] : world.tagged) {
    EXPECT_GE(state.position.x(), -0.01);
    EXPECT_LE(state.position.x(), 0.01);
    wrapped += state.position.x() < 0.0 ? 1 : 0;
  }
  EXPECT_GT(wrapped, 20);
  EXPECT_GT(world.set.openFraction({-0.0095, 0, 0.0005}), 0.99);
  EXPECT_GT(world.set.openFraction({0.0095, 0, 0.0005}), 0.99);
  EXPECT_EQ(world.set.openFraction({0.0, 0, 0.0005}), 0.0);
  EXPECT_TRUE(world.set.update(moveChange(1, Vec3{-0.01, 0, 0}), {}).ok());
}

TEST(WoundSet, TheLargestSlotWorks) {
  WorldDescription description = plainDescription();
  description.max_wounds = 5000;
  description.domain.lower = Vec3::Constant(-1.0);
  description.domain.upper = Vec3::Constant(1.0);
  ThroatWorld world{description};
  for (int i = 0; i < static_cast<int>(kMaxInletSlots); ++i) {
    const int row = i / 100;
    ASSERT_TRUE(world.set.add(discAt({0.01 * (i % 100), 0.01 * row, 0}, 0.0004, 1e-9)).ok());
  }
  const auto more = world.set.add(discAt({-0.5, 0, 0}, 0.0004, 1e-9));
  EXPECT_EQ(more.status().code(), StatusCode::capacity);
  EXPECT_NE(more.status().message().find("1023"), std::string::npos) << more.status().message();
  world.step(1e-3);
  EXPECT_GE(world.tagged.size(), 1u);
}

// What is not passed over by the box of a cell must open as if it had been asked point by point.
TEST(WoundSet, OpensNothingInABoxThatMayNotOpen) {
  ThroatWorld world{plainDescription()};
  WoundDescription wound = discWound(0.004, 8e-6);
  wound.position = {0.01, 0.0, 0.0};
  ASSERT_TRUE(world.set.add(wound).ok());
  world.step(1e-4);
  int open = 0;
  int closed = 0;
  for (double x = -0.01; x < 0.03; x += 7e-4) {
    for (double z = -0.01; z < 0.01; z += 7e-4) {
      const Vec3 point{x, 0.001, z};
      const Vec3 corner{0.0012, 0.002, 0.0005};
      if (world.set.mayOpen(point - corner, point + corner)) {
        ++open;
        continue;
      }
      ++closed;
      for (const double part : {-1.0, -0.4, 0.0, 0.7, 1.0}) EXPECT_EQ(world.set.openFraction(point + part * corner), 0.0);
    }
  }
  EXPECT_GT(open, 20);
  EXPECT_GT(closed, 100);
  EXPECT_TRUE(world.set.mayOpen(wound.position, wound.position));
  ASSERT_TRUE(world.set.remove(1, [](const Throat&) {}).ok());
  EXPECT_FALSE(world.set.mayOpen(wound.position, wound.position));
}

}  // namespace
}  // namespace bleedsim::sph
