// Applied forces of a running world: the sum over the fluid is the force, exactly; sources have bounds, ends and names.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Blood without effects of its own: what moves was pushed.
WorldDescription pushable(std::uint32_t max_sources = 64) {
  WorldDescription description = test::freeBlock({12, 12, 12});
  description.effects = {};
  description.effects.applied_force = AppliedForceSettings{max_sources};
  return description;
}

SetForce source(ForceKey key, const Vec3& force, double radius = 0.004, const Vec3& position = Vec3::Zero()) {
  SetForce set;
  set.key = key;
  set.position = position;
  set.radius = radius;
  set.force = force;
  return set;
}

/// The momentum that one step from rest brings, per second: a force is felt from the closing half kick of its first step on.
Vec3 pushOfFirstStep(const World& world) { return test::statsOf(world).momentum / (0.5 * test::statsOf(world).dt); }

TEST(AppliedForces, TheSumOverTheFluidIsTheForce) {
  const Vec3 force{0.002, -0.001, 0.0005};
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    for (const double radius : {0.0007, 0.002, 0.0051, 0.05}) {
      const auto world = test::makeWorld(pushable(), {.precision = precision});
      ASSERT_TRUE(world->apply(source(1, force, radius, {0.0012, 0.0003, 0.0003})).ok());
      ASSERT_TRUE(world->step(1.0).ok());
      ASSERT_EQ(test::counterOf(*world, Counter::acceleration_clamped), 0u);
      EXPECT_LT((pushOfFirstStep(*world) - force).norm(), 1e-6 * force.norm()) << "radius " << radius;
    }
  }
}

TEST(AppliedForces, SourcesAddUp) {
  const auto world = test::makeWorld(pushable());
  ASSERT_TRUE(world->apply(source(1, {0.001, 0.0, 0.0})).ok());
  ASSERT_TRUE(world->apply(source(2, {0.0, 0.002, 0.0}, 0.003, {0.002, 0.0, 0.001})).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((pushOfFirstStep(*world) - Vec3{0.001, 0.002, 0.0}).norm(), 1e-8);
}

TEST(AppliedForces, OnlyFluidWithinTheRadiusMoves) {
  const Vec3 position{0.002, -0.001, 0.0};
  const auto world = test::makeWorld(pushable());
  ASSERT_TRUE(world->apply(source(1, {0.001, 0.0, 0.0}, 0.003, position)).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  const FrameBuffer frame = test::frameOf(*world);
  int moved = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const bool within = (test::positionOf(frame, i) - position).norm() < 0.003;
    EXPECT_EQ(test::velocityOf(frame, i).norm() > 0.0, within) << test::positionOf(frame, i).transpose();
    moved += within ? 1 : 0;
  }
  EXPECT_EQ(moved, 136) << "lattice points within three spacings of a corner of the lattice";
}

TEST(AppliedForces, ReachAcrossAPeriodicSide) {
  WorldDescription description = test::periodicBox({12, 12, 12});
  description.effects = {};
  description.effects.applied_force.emplace();
  const auto world = test::makeWorld(description);
  ASSERT_TRUE(world->apply(source(1, {0.0, 0.0, 0.001}, 0.003, {0.0005, 0.006, 0.006})).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((pushOfFirstStep(*world) - Vec3{0.0, 0.0, 0.001}).norm(), 1e-9);
  const FrameBuffer frame = test::frameOf(*world);
  bool beyond = false;
  for (std::size_t i = 0; i < frame.count; ++i) {
    beyond = beyond || (test::positionOf(frame, i).x() > 0.009 && test::velocityOf(frame, i).z() > 0.0);
  }
  EXPECT_TRUE(beyond);
}

TEST(AppliedForces, SetReplacesTheSourceOfItsKey) {
  const auto world = test::makeWorld(pushable(1));
  ASSERT_TRUE(world->apply(source(9, {0.5, 0.0, 0.0})).ok());
  ASSERT_TRUE(world->apply(source(9, {0.0, 0.0, 0.001})).ok()) << "a replacement needs no room";
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((pushOfFirstStep(*world) - Vec3{0.0, 0.0, 0.001}).norm(), 1e-9);
}

TEST(AppliedForces, RemoveEndsASourceAndFreesItsPlace) {
  const auto world = test::makeWorld(pushable(2));
  ASSERT_TRUE(world->apply(source(1, {0.001, 0.0, 0.0})).ok());
  ASSERT_TRUE(world->apply(source(2, {0.001, 0.0, 0.0})).ok());
  const auto full = world->apply(source(3, {0.001, 0.0, 0.0}));
  ASSERT_FALSE(full.ok());
  EXPECT_EQ(full.status().code(), StatusCode::capacity);
  EXPECT_NE(full.status().message().find("max_sources"), std::string::npos);
  ASSERT_TRUE(world->apply(RemoveForce{1}).ok());
  ASSERT_TRUE(world->apply(source(3, {0.0, 0.001, 0.0})).ok());
  ASSERT_TRUE(world->apply(RemoveForce{2}).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((pushOfFirstStep(*world) - Vec3{0.0, 0.001, 0.0}).norm(), 1e-9);
  for (const ForceKey key : {ForceKey{1}, ForceKey{2}, ForceKey{77}}) {
    const auto unknown = world->apply(RemoveForce{key});
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.status().code(), StatusCode::not_found);
  }
}

TEST(AppliedForces, ASourceEndsAtItsTime) {
  const auto world = test::makeWorld(pushable());
  SetForce push = source(1, {0.001, 0.0, 0.0});
  push.until = 0.001;
  ASSERT_TRUE(world->apply(push).ok());
  while (world->time() < 0.0015) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::force_expired), 1u);
  const Vec3 momentum = test::statsOf(*world).momentum;
  const double longest = 0.4 * test::kSpacing / world->speedOfSound();
  EXPECT_NEAR(momentum.x(), 0.001 * 0.001, 0.001 * longest) << "force times time, to a step";
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((test::statsOf(*world).momentum - momentum).norm(), 1e-6 * momentum.norm());
  EXPECT_EQ(test::counterOf(*world, Counter::force_expired), 1u);
  EXPECT_FALSE(world->apply(RemoveForce{1}).ok()) << "an ended source is gone";
}

TEST(AppliedForces, ASourceWithoutFluidIsCountedEveryStep) {
  const auto world = test::makeWorld(pushable());
  ASSERT_TRUE(world->apply(source(1, {0.001, 0.0, 0.0}, 0.002, {0.03, 0.0, 0.0})).ok());
  ASSERT_TRUE(world->apply(source(2, {0.001, 0.0, 0.0})).ok());
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::force_without_fluid), 4u);
}

TEST(AppliedForces, AThroatIsNotPushed) {
  WorldDescription description = test::woundOnPlane(0.003, 3e-6);
  description.effects.gravity.reset();
  description.effects.applied_force.emplace();
  const auto world = test::makeWorld(description);
  ASSERT_TRUE(world->apply(source(1, {0.0, 0.0, -1e-4}, 0.01)).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::force_without_fluid), 1u) << "behind the patch there is no free fluid yet";
}

TEST(AppliedForces, BadSourcesAreRefused) {
  const auto world = test::makeWorld(pushable());
  const auto untouched = test::makeWorld(pushable());
  std::vector<SetForce> bad{
      source(1, {0.001, 0.0, 0.0}, 0.0), source(1, {0.001, 0.0, 0.0}, -0.001), source(1, {0.001, 0.0, 0.0}, 1e3),
      source(1, {1e7, 0.0, 0.0}),        source(1, {1e300, 1e300, 1e300}),
  };
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    bad.push_back(source(1, {0.0, value, 0.0}));
    bad.push_back(source(1, {0.001, 0.0, 0.0}, value));
    bad.push_back(source(1, {0.001, 0.0, 0.0}, 0.004, {0.0, 0.0, value}));
  }
  bad.push_back(source(1, {0.001, 0.0, 0.0}));
  bad.back().until = kNan;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto answer = world->apply(bad[i]);
    ASSERT_FALSE(answer.ok()) << i;
    EXPECT_EQ(answer.status().code(), StatusCode::invalid_argument) << i;
    EXPECT_GT(answer.status().message().size(), 20u) << i;
  }
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    ASSERT_TRUE(untouched->step(1.0).ok());
  }
  EXPECT_EQ(world->stateHash(), untouched->stateHash());
}

TEST(AppliedForces, ASphereThatMissesTheDomainIsRefused) {
  WorldDescription description = pushable();
  description.domain.lower = {-0.02, -0.02, -0.02};
  description.domain.upper = {0.02, 0.02, 0.02};
  const auto world = test::makeWorld(description);
  const auto untouched = test::makeWorld(description);
  const Vec3 force{0.001, 0.0, 0.0};
  EXPECT_TRUE(world->apply(source(1, force, 0.0041, {0.024, 0.0, 0.0})).ok()) << "it just reaches in";
  ASSERT_TRUE(world->apply(RemoveForce{1}).ok());
  for (const Vec3& position : {Vec3{0.024, 0.0, 0.0}, Vec3{0.0, -1e3, 0.0}, Vec3{0.023, 0.023, -0.021}}) {
    const auto answer = world->apply(source(1, force, 0.004, position));
    ASSERT_FALSE(answer.ok()) << position.transpose();
    EXPECT_EQ(answer.status().code(), StatusCode::invalid_argument);
    EXPECT_LE(answer.status().message().size(), 127u) << "a reply would cut it";
  }
  const auto answer = world->apply(source(1, force, 0.004, {0.024, 0.0, 0.0}));
  EXPECT_EQ(answer.status().message(),
            "position (0.024, 0, 0) m, radius 0.004 m: outside the domain, x from -0.02 to 0.02 m; move it in");
  ASSERT_TRUE(world->step(1.0).ok());
  ASSERT_TRUE(untouched->step(1.0).ok());
  EXPECT_EQ(world->stateHash(), untouched->stateHash());
  EXPECT_EQ(test::counterOf(*world, Counter::force_without_fluid), 0u);
}

TEST(AppliedForces, APeriodicSideIsNeverMissed) {
  WorldDescription description = test::periodicBox({12, 12, 12});
  description.effects = {};
  description.effects.applied_force.emplace();
  const auto world = test::makeWorld(description);
  ASSERT_TRUE(world->apply(source(1, {0.0, 0.0, 0.001}, 0.003, {0.5, 0.006, 0.006})).ok());
  ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_LT((pushOfFirstStep(*world) - Vec3{0.0, 0.0, 0.001}).norm(), 1e-9);
}

TEST(AppliedForces, WithoutTheEffectTheyAreUnsupported) {
  const auto world = test::makeWorld(test::freeBlock({3, 3, 3}));
  for (const Command& command : {Command{source(1, {0.001, 0.0, 0.0})}, Command{RemoveForce{1}}}) {
    const auto answer = world->apply(command);
    ASSERT_FALSE(answer.ok());
    EXPECT_EQ(answer.status().code(), StatusCode::unsupported);
    EXPECT_NE(answer.status().message().find("applied_force"), std::string::npos);
  }
}

TEST(AppliedForces, TheLargestForceStaysFiniteAndIsClamped) {
  const auto world = test::makeWorld(pushable());
  ASSERT_TRUE(world->apply(source(1, {1e6, 0.0, 0.0})).ok());
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_GT(test::counterOf(*world, Counter::acceleration_clamped), 0u);
  EXPECT_LE(test::statsOf(*world).max_speed, 2.0 * world->speedOfSound() * (1.0 + 1e-5));
}

}  // namespace
}  // namespace bleedsim::sph
