// What an instrument does to real blood, and no longer does once it is silent.
#include "tests/support/scenes.h"
#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

constexpr double kForce = 1e-4;  // N
constexpr int kSteps = 40;

/// A free block of blood: without outer forces its momentum stays, whatever its particles do to each other.
LoadedScene freeBlood() {
  auto scene = std::make_shared<scene::SceneDescription>();
  scene->name = "free";
  scene->world = test::freeBlock({8, 8, 8}, 0.1);
  scene->world.effects.applied_force.emplace();
  auto world = test::makeWorld(scene->world);
  FrameMailbox::Buffers frames = FrameMailbox::makeBuffers(scene->world.capacity);
  return {std::move(scene), std::move(world), std::move(frames)};
}

class InstrumentMotionTest : public SimulationTest {
 protected:
  void SetUp() override {
    const SimulationOptions options{{dds::PaceMode::maximum, 1.0}, {}, {}};
    simulation_ = std::make_unique<Simulation>(options, freeBlood(), fakeFactory(log_), channels_, now_);
  }
  void push() {
    InstrumentInput input = sample(1);
    input.sample.radius = 0.02;
    input.sample.force = {0.0, 0.0, kForce};
    ASSERT_TRUE(channels_.commands.tryPush(input));
    tick();
  }
  double time() const { return simulation_->world().time(); }
  sph::Vec3 momentum() const { return test::statsOf(simulation_->world()).momentum; }
  /// What the next steps add to the momentum, by the momentum that the tool's force would add.
  sph::Vec3 gainOfSteps() {
    const sph::Vec3 before = momentum();
    const double start = time();
    ticks(kSteps);
    return (momentum() - before) / (kForce * (time() - start));
  }
};

TEST_F(InstrumentMotionTest, ASilentToolMovesNothingAnyMore) {
  push();
  EXPECT_LT((gainOfSteps() - sph::Vec3::UnitZ()).norm(), 1e-3) << "the tool pushes with its force";
  now_ += std::chrono::milliseconds{100};
  tick();  // its opening half kick is the last one that knew of the tool
  EXPECT_LT(gainOfSteps().norm(), 1e-3) << "the tool is silent";
  EXPECT_GT(momentum().z(), 0.0) << "what it did stays done";
}

TEST_F(InstrumentMotionTest, AToolWhoseWriterIsGoneMovesNothingAnyMore) {
  push();
  ASSERT_TRUE(channels_.commands.tryPush(WriterLost{5}));
  tick();
  EXPECT_LT(gainOfSteps().norm(), 1e-3);
}

TEST_F(InstrumentMotionTest, AToolThatLeavesTheDomainIsCountedAndPushesNoLonger) {
  push();
  InstrumentInput away = sample(2);
  away.sample.position = {9.0, 0.0, 0.0};
  away.sample.force = {0.0, 0.0, kForce};
  ASSERT_TRUE(channels_.commands.tryPush(away));
  tick();
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_refused), 1U);
  EXPECT_LT(gainOfSteps().norm(), 1e-3);
}

TEST_F(InstrumentMotionTest, ASampleOutOfTheDomainChangesNothing) {
  const LoadedScene twin = freeBlood();
  InstrumentInput away = sample(1);
  away.sample.position = {0.0, 9.0, 0.0};
  ASSERT_TRUE(channels_.commands.tryPush(away));
  ticks(kSteps);
  while (twin.world->stepCount() < simulation_->world().stepCount()) ASSERT_TRUE(twin.world->step(1.0).ok());
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_refused), 1U);
  EXPECT_EQ(simulation_->world().stateHash(), twin.world->stateHash());
  EXPECT_TRUE(journal().empty());
}

}  // namespace
}  // namespace bleedsim::daemon
