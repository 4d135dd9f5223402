#include <gmock/gmock.h>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using testing::HasSubstr;

TEST_F(SimulationTest, ResetStartsANewEpochAtStepZero) {
  start();
  ticks(20);
  const std::uint32_t before = simulation_->epoch();
  ask(sph::AddWound{});
  journal();
  push(dds::ResetSession{});
  tick();
  EXPECT_EQ(channels_.board.read().report.state, dds::SessionState::loading);
  loadUntilDone();
  const dds::Reply done = reply();
  EXPECT_EQ(done.code, dds::ReplyCode::accepted);
  EXPECT_EQ(done.applied_step, 0U);
  EXPECT_EQ(done.epoch, before + 1);
  EXPECT_EQ(simulation_->state(), dds::SessionState::running);
  EXPECT_TRUE(simulation_->world().wounds().empty());
  const auto scene = channels_.board.takeScene();
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->epoch, before + 1);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].number, 1U) << "numbers start again in each epoch";
  EXPECT_EQ(entries[0].epoch, before + 1);
}

TEST_F(SimulationTest, ResetKeepsAPauseAndTheOutput) {
  start();
  ask(dds::SetOutput{50.0, sph::kFrameDensity});
  ask(dds::PauseSession{});
  push(dds::ResetSession{});
  tick();
  loadUntilDone();
  reply();
  EXPECT_EQ(simulation_->state(), dds::SessionState::paused);
  EXPECT_EQ(simulation_->world().stepCount(), 0U);
  EXPECT_EQ(channels_.board.read().report.frame_rate, 50.0);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame.step, 0U);
  EXPECT_EQ(frame->frame.attributes, static_cast<std::uint32_t>(sph::kFrameDensity));
}

TEST_F(SimulationTest, LoadsAnotherScene) {
  start();
  ticks(20);
  ask(dds::SetOutput{50.0, {}});
  push(dds::LoadScene{"second"});
  tick();
  loadUntilDone();
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted);
  const auto scene = channels_.board.takeScene();
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->name, "second");
  EXPECT_EQ(scene->frame_rate, 10.0) << "another scene brings its own output";
}

TEST_F(SimulationTest, ABrokenSceneLeavesTheOldWorldAsItWas) {
  start();
  ticks(20);
  const std::uint64_t hash = simulation_->world().stateHash();
  const std::uint32_t epoch = simulation_->epoch();
  push(dds::LoadScene{"broken"});
  tick();
  while (simulation_->state() == dds::SessionState::loading) {
    EXPECT_EQ(simulation_->world().stateHash(), hash) << "the world waits while a scene is loaded";
    channels_.commands.wakeup().wait({});
    tick();
  }
  const dds::Reply refused = reply();
  EXPECT_EQ(refused.code, dds::ReplyCode::scene);
  EXPECT_THAT(refused.reason, HasSubstr("domain: missing"));
  EXPECT_EQ(simulation_->epoch(), epoch);
  EXPECT_EQ(simulation_->world().stateHash(), hash + 1000) << "and then does its next step";
  EXPECT_TRUE(journal().empty());
}

TEST_F(SimulationTest, ASceneThatOnlyTheSolverCouldRefuseLeavesTheWorldAsItWas) {
  const auto scene = [](const std::string& wounds) {
    return "domain { lower_m { x: -0.03 y: -0.03 z: -0.01 } upper_m { x: 0.03 y: 0.03 z: 0.03 } capacity: 2000 }\n"
           "resolution { spacing_m: 0.002 } compressibility { design_speed_m_per_s: 0.3 } effects { pressure {} }\n"
           "fluid_blocks { lower_m {} upper_m { x: 0.01 y: 0.01 z: 0.01 } }\n" +
           wounds;
  };
  const SceneFactory factory = worldFactory({});
  Result<LoadedScene> first = factory({scene(""), {}});
  ASSERT_TRUE(first.ok()) << first.status().message();
  const SimulationOptions options{{dds::PaceMode::maximum, 1.0}, {}, {}};
  simulation_ = std::make_unique<Simulation>(options, std::move(*first), factory, channels_, now_);
  ticks(20);
  ask(dds::PauseSession{});
  const std::uint64_t hash = simulation_->world().stateHash();
  push(
      dds::LoadScene{scene("wounds { disc { radius_m: 0.004 } flow_ml_per_s: 100 }\n"
                           "wounds { position_m { x: 0.005 } disc { radius_m: 0.004 } flow_ml_per_s: 1 }\n"
                           "wounds { position_m { x: 0.028 } disc { radius_m: 0.004 } flow_ml_per_s: 1 }\n"
                           "fluid_blocks { lower_m { z: 0.02 } upper_m { x: 0.01 y: 0.01 z: 0.04 } }\n")});
  tick();
  loadUntilDone();
  const dds::Reply refused = reply();
  EXPECT_EQ(refused.code, dds::ReplyCode::scene);
  EXPECT_EQ(refused.applied_step, simulation_->world().stepCount() + 1);
  EXPECT_THAT(refused.reason, testing::StartsWith("the scene has 4 problems:"));
  for (const char* path :
       {"wounds[0].flow_ml_per_s", "wounds[1].position_m", "wounds[2].position_m.x", "fluid_blocks[1].upper_m.z"}) {
    EXPECT_THAT(refused.reason, HasSubstr(path));
  }
  EXPECT_EQ(simulation_->world().stateHash(), hash);
  EXPECT_EQ(simulation_->state(), dds::SessionState::paused);
}

TEST_F(SimulationTest, RefusesWhatTheComingWorldWouldNotKnow) {
  start();
  push(dds::ResetSession{});
  push(sph::AddWound{});
  push(dds::ResetSession{});
  push(dds::PauseSession{});
  push(dds::SetPace{{dds::PaceMode::maximum, 1.0}});
  tick();
  for (int i = 0; i < 3; ++i) {
    const dds::Reply refused = reply();
    EXPECT_EQ(refused.code, dds::ReplyCode::state);
    EXPECT_THAT(refused.reason, HasSubstr("being loaded"));
  }
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted);
  loadUntilDone();
  EXPECT_EQ(reply().key.seq, 1U) << "the reset is answered when it is done";
}

TEST_F(SimulationTest, ShutsDownWhileAWorldIsBeingBuilt) {
  start();
  push(dds::ResetSession{});
  push(dds::ShutdownSession{});
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::stop);
}

}  // namespace
}  // namespace bleedsim::daemon
