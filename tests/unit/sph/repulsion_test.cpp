// Repulsion (35)(36) in whole worlds: collisions give back what they took, blood at rest does not feel it, the time step follows.
#include <cmath>
#include <gtest/gtest.h>

#include "service/sph/world_setup.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

FluidBlock particleAt(const Vec3& position, const Vec3& velocity) {
  FluidBlock block;
  block.lower = position - Vec3::Constant(0.5 * test::kSpacing);
  block.upper = position + Vec3::Constant(0.5 * test::kSpacing);
  block.velocity = velocity;
  return block;
}

/// Two particles `gap` spacings apart that close at `speed` x c0 along a slanted line; nothing acts but repulsion.
WorldDescription collision(double gap, double speed, const RepulsionSettings& settings) {
  WorldDescription description = test::emptyScene();
  description.effects.repulsion = settings;
  const Vec3 along{0.48, 0.6, 0.64};
  const Vec3 half = 0.5 * gap * test::kSpacing * along;
  const Vec3 velocity = 0.5 * speed * speedOfSound(description) * along;
  description.fluid_blocks = {particleAt(-half, velocity), particleAt(half, -velocity)};
  return description;
}

/// Speed at which the two part over that at which they met.
double restitution(const WorldDescription& description) {
  const auto world = test::makeWorld(description);
  const FrameBuffer before = test::frameOf(*world);
  const double met = (test::velocityOf(before, 0) - test::velocityOf(before, 1)).norm();
  double apart = 0.0;
  for (int k = 0; k < 5000 && apart < 2.0 * test::kSpacing; ++k) {
    EXPECT_TRUE(world->step(1.0).ok());
    const FrameBuffer frame = test::frameOf(*world);
    const Vec3 offset = test::positionOf(frame, 0) - test::positionOf(frame, 1);
    const Vec3 velocity = test::velocityOf(frame, 0) - test::velocityOf(frame, 1);
    apart = offset.dot(velocity) > 0.0 ? offset.norm() : 0.0;
    if (apart >= 2.0 * test::kSpacing) return velocity.norm() / met;
  }
  ADD_FAILURE() << "the particles never parted";
  return 0.0;
}

/// The largest and smallest restitution over where in a step the particles first touch.
std::pair<double, double> restitutions(double speed, const RepulsionSettings& settings) {
  double lowest = 1e9;
  double highest = 0.0;
  for (int phase = 0; phase < 12; ++phase) {
    const double e = restitution(collision(1.5 + phase / 120.0, speed, settings));
    lowest = std::min(lowest, e);
    highest = std::max(highest, e);
  }
  return {lowest, highest};
}

// physics.md: D* = 1.5, v = c0, dt = 0.1 dx/c0 gives 1.008 without damping, 45 at 0.4 dx/c0.
TEST(Repulsion, ACollisionAtTheSpeedOfSoundGivesBackWhatItTook) {
  RepulsionSettings settings;
  settings.damping = 0.0;
  const auto [lowest, highest] = restitutions(1.0, settings);
  RecordProperty("undamped_lowest", std::to_string(lowest));
  RecordProperty("undamped_highest", std::to_string(highest));
  EXPECT_LE(highest, 1.01);
  EXPECT_GE(lowest, 0.95);
}

TEST(Repulsion, DampingOnlyTakes) {
  const auto [lowest, highest] = restitutions(1.0, {});
  RecordProperty("damped_lowest", std::to_string(lowest));
  RecordProperty("damped_highest", std::to_string(highest));
  EXPECT_LE(highest, 1.0);
  EXPECT_GE(lowest, 0.0);
}

TEST(Repulsion, NoCollisionGainsEnergyAtAnySpeedOrStiffness) {
  for (const double speed : {0.1, 0.5, 1.0, 2.0}) {
    for (const RepulsionSettings& settings :
         {RepulsionSettings{}, RepulsionSettings{.strength = 10.0}, RepulsionSettings{.power_1 = 16, .power_2 = 1},
          RepulsionSettings{.contact_distance = 0.5}}) {
      const auto [lowest, highest] = restitutions(speed, settings);
      EXPECT_LE(highest, 1.01) << "speed " << speed << ", strength " << settings.strength << ", powers " << settings.power_1;
      EXPECT_GE(lowest, 0.0);
    }
  }
}

TEST(Repulsion, BloodAtRestDoesNotFeelIt) {
  for (const double contact : {0.9, 1.0}) {
    WorldDescription description = test::freeBlock({8, 8, 8});
    description.effects = {};
    description.effects.repulsion = RepulsionSettings{.contact_distance = contact};
    const auto world = test::makeWorld(description);
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(world->step(1.0).ok());
    EXPECT_LT(test::statsOf(*world).max_speed, 1e-5 * world->speedOfSound()) << contact;
  }
}

TEST(Repulsion, ShortensTheTimeStep) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  const double c0 = speedOfSound(description);
  const auto step_of = [](const WorldDescription& d) {
    const auto world = test::makeWorld(d);
    EXPECT_TRUE(world->step(1.0).ok());
    return test::statsOf(*world).dt;
  };
  const double unit = test::kSpacing / c0;
  EXPECT_NEAR(step_of(description), 0.4 * unit, 1e-3 * unit);
  description.effects.repulsion.emplace();
  EXPECT_NEAR(step_of(description), 0.1 * unit, 1e-6 * unit);
  description.effects.repulsion->strength = 6.0;
  EXPECT_NEAR(step_of(description), 0.05 * unit, 1e-6 * unit);
  description.effects.repulsion->strength = 1e-3;
  EXPECT_NEAR(step_of(description), 0.1 * unit, 1e-6 * unit);
  description.effects.repulsion->strength = 1.5;
  description.fluid_blocks.front().velocity = {1.5 * c0, 0.0, 0.0};
  EXPECT_NEAR(step_of(description), 0.1 / 3.0 * unit, 1e-6 * unit) << "two particles may close at twice the largest speed";
}

// push(pe) = D* (pe^n1 - pe^n2) pe^2/(contact distance)^2 is 0.85 6.25 c0^2/dx there, or pe is 2.
TEST(Repulsion, APairStaysBelowTheBoundOnAccelerations) {
  for (const RepulsionSettings& settings :
       {RepulsionSettings{}, RepulsionSettings{.strength = 100.0}, RepulsionSettings{.contact_distance = 0.5, .power_1 = 16}}) {
    const double pe = contactOverlap(settings);
    EXPECT_LT(pe, 2.0);
    const double push = settings.strength * (std::pow(pe, settings.power_1) - std::pow(pe, settings.power_2)) * pe * pe /
                        (settings.contact_distance * settings.contact_distance);
    EXPECT_NEAR(push, 5.3125, 1e-6);
  }
  EXPECT_EQ(contactOverlap({.strength = 0.01}), 2.0);
  EXPECT_EQ(contactOverlap({.strength = 0.0}), 2.0);
}

// Two lopsided lattices in each other: a bound on single particles takes momentum, one on pairs does not.
TEST(Repulsion, DeepContactsKeepMomentum) {
  WorldDescription description = test::emptyScene();
  description.effects.repulsion.emplace();
  FluidBlock block;
  block.lower = Vec3::Zero();
  block.upper = test::kSpacing * Vec3{4, 4, 4};
  description.fluid_blocks.push_back(block);
  block.lower += test::kSpacing * Vec3{0.35, 0.2, 0.1};
  block.upper += test::kSpacing * Vec3{0.35, 0.2, -1.9};
  description.fluid_blocks.push_back(block);
  const auto world = test::makeWorld(description);
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(world->step(1.0).ok());
  const FrameBuffer frame = test::frameOf(*world);
  double flow = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) flow += world->particleMass() * test::velocityOf(frame, i).norm();
  RecordProperty("drift_1e9", std::to_string(1e9 * test::statsOf(*world).momentum.norm() / flow));
  RecordProperty("clamped", std::to_string(test::counterOf(*world, Counter::acceleration_clamped)));
  EXPECT_LT(test::statsOf(*world).momentum.norm(), 1e-6 * flow);
}

TEST(Repulsion, ParticlesOnOneSpotAreParted) {
  WorldDescription description = collision(1e-12, 0.0, {});
  description.effects.pressure.emplace();
  const auto world = test::makeWorld(description);
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_FALSE(world->faulted());
  EXPECT_EQ(test::counterOf(*world, Counter::coincident_parted), 2u);
  const FrameBuffer frame = test::frameOf(*world);
  EXPECT_GT((test::positionOf(frame, 0) - test::positionOf(frame, 1)).norm(), 0.9 * test::kSpacing);
}

}  // namespace
}  // namespace bleedsim::sph
