#include <gmock/gmock.h>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

const SimulationOptions kRealTime{{dds::PaceMode::real_time, 1.0}, {}, {}};

TEST_F(SimulationTest, PublishesTheStartAndThenTheFirstStateOfEachPeriod) {
  start();
  std::vector<std::uint64_t> steps;
  for (int i = 0; i < 350; ++i) {
    if (const dds::FrameSnapshot* frame = channels_.frames.load()) steps.push_back(frame->frame.step);
    tick();
  }
  EXPECT_THAT(steps, testing::ElementsAre(0U, 100U, 200U, 300U));
  EXPECT_EQ(channels_.frames.overwritten(), 0U);
}

TEST_F(SimulationTest, CountsFramesThatNobodyFetched) {
  start();
  ticks(250);
  ASSERT_NE(channels_.frames.load(), nullptr);
  EXPECT_EQ(channels_.frames.overwritten(), 2U);
}

TEST_F(SimulationTest, WaitsUntilTheNextStateIsDue) {
  start(kRealTime);
  tick();
  EXPECT_EQ(simulation_->world().stepCount(), 1U);
  const Simulation::Next next = tick();
  EXPECT_EQ(simulation_->world().stepCount(), 1U);
  EXPECT_EQ(next.kind, Simulation::Next::Kind::wait);
  ASSERT_TRUE(next.until.has_value());
  EXPECT_EQ(std::chrono::round<milliseconds>(*next.until - now_), milliseconds{1});
}

TEST_F(SimulationTest, CatchesUpStepByStepAndSaysHowFarItIsBehind) {
  start(kRealTime);
  now_ += milliseconds{500};
  ticks(100);
  EXPECT_EQ(simulation_->world().stepCount(), 100U);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr);
  EXPECT_NEAR(frame->behind, 0.4, 1e-9);
  EXPECT_NEAR(frame->real_time_factor, 0.2, 1e-9);
  ticks(1000);
  EXPECT_NEAR(simulation_->world().time(), 0.5, 2e-3);
}

TEST_F(SimulationTest, EndsOnceItsDurationIsReachedAndShowsThatState) {
  start({{dds::PaceMode::maximum, 1.0}, {}, 0.0105});
  while (tick().kind != Simulation::Next::Kind::stop) ASSERT_LT(simulation_->world().stepCount(), 100U);
  EXPECT_EQ(simulation_->world().stepCount(), 11U) << "the first step at or after it, of 1 ms each";
  EXPECT_DOUBLE_EQ(channels_.frames.load()->stats.time, 0.011);
}

TEST_F(SimulationTest, TakesNoStepWhereItsDurationIsOverFromTheStart) {
  start({{dds::PaceMode::maximum, 1.0}, {}, 0.0});
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::stop);
  EXPECT_EQ(simulation_->world().stepCount(), 0U);
  EXPECT_NE(channels_.frames.load(), nullptr) << "its state is shown all the same";
}

// A session that resumes at 12 ms with a duration of 15 ms has 3 ms left; at 15 ms it has none.
TEST_F(SimulationTest, WhatRanBeforeAResumeCountsForTheDuration) {
  for (const std::uint64_t before : {12U, 15U}) {
    LoadedScene resumed = fakeScene("first", log_);
    while (resumed.world->stepCount() < before) ASSERT_TRUE(resumed.world->step(1.0).ok());
    resumed.restored.emplace();
    resumed.restored->loaded = resumed.scene;
    resumed.restored->head.mark.frame_rate = 10.0;
    simulation_ = std::make_unique<Simulation>(SimulationOptions{{dds::PaceMode::maximum, 1.0}, {}, 0.015}, std::move(resumed),
                                               fakeFactory(log_), channels_, now_);
    while (tick().kind != Simulation::Next::Kind::stop) ASSERT_LT(simulation_->world().stepCount(), 100U);
    EXPECT_EQ(simulation_->world().stepCount(), 15U);
  }
}

TEST_F(SimulationTest, KeysCommandsToTheStepThatUsesThemFirst) {
  start();
  ticks(7);
  push(sph::AddWound{});
  push(sph::RemoveWound{1});
  push(sph::RemoveWound{44});
  tick();
  ASSERT_EQ(log_->applied.size(), 3U);
  EXPECT_EQ(log_->applied[0].first, 7U);
  const dds::Reply added = reply();
  EXPECT_EQ(added.code, dds::ReplyCode::accepted);
  EXPECT_EQ(added.applied_step, 8U);
  EXPECT_EQ(added.object_id, 1U);
  EXPECT_EQ(added.epoch, simulation_->epoch());
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted);
  const dds::Reply unknown = reply();
  EXPECT_EQ(unknown.code, dds::ReplyCode::not_found);
  EXPECT_THAT(unknown.reason, HasSubstr("no such wound"));

  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 2U) << "the refused request is no input";
  EXPECT_EQ(entries[0].number, 1U);
  EXPECT_EQ(entries[1].number, 2U);
  EXPECT_EQ(entries[0].step, 7U);
  EXPECT_EQ(std::get<dds::RequestTaken>(entries[0].input).object_id, 1U);
}

TEST_F(SimulationTest, EndsForcesInSimulatedTime) {
  start();
  ticks(10);
  EXPECT_EQ(ask(dds::PushForce{sph::Vec3::Zero(), 0.01, {0.0, 0.0, 1.0}, 0.25}).code, dds::ReplyCode::accepted);
  ask(dds::PushForce{sph::Vec3::Zero(), 0.01, {0.0, 0.0, 2.0}, 0.25});
  ASSERT_EQ(log_->forces.size(), 2U) << "each request has a source of its own";
  EXPECT_NEAR(log_->forces.begin()->second.until, 0.26, 1e-12);
}

TEST_F(SimulationTest, StandsStillInAPauseAndStepsByHand) {
  start();
  ticks(5);
  EXPECT_EQ(ask(dds::StepSession{3}).code, dds::ReplyCode::state);
  ask(dds::PauseSession{});
  const std::uint64_t paused_at = simulation_->world().stepCount();
  ticks(10);
  EXPECT_EQ(simulation_->world().stepCount(), paused_at);
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::wait);
  EXPECT_EQ(channels_.board.read().report.state, dds::SessionState::paused);

  channels_.frames.load();
  const dds::Reply stepped = ask(dds::StepSession{3});
  EXPECT_EQ(stepped.applied_step, paused_at + 1);
  ticks(10);
  EXPECT_EQ(simulation_->world().stepCount(), paused_at + 3);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr) << "the state after the last step is shown";
  EXPECT_EQ(frame->frame.step, paused_at + 3);
  EXPECT_EQ(channels_.board.read().report.step, paused_at + 3);

  ask(dds::ResumeSession{});
  ticks(2);
  EXPECT_EQ(simulation_->world().stepCount(), paused_at + 6);
}

TEST_F(SimulationTest, TakesCommandsInAPause) {
  start();
  ask(dds::PauseSession{});
  const std::uint64_t step = simulation_->world().stepCount();
  EXPECT_EQ(ask(sph::AddWound{}).applied_step, step + 1);
  EXPECT_EQ(simulation_->world().stepCount(), step);
}

TEST_F(SimulationTest, ChangesFrameRateAndAttributes) {
  start();
  channels_.frames.load();
  EXPECT_EQ(ask(dds::SetOutput{100.0, sph::kFrameVelocity}).code, dds::ReplyCode::accepted);
  ticks(10);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame.step, 10U);
  EXPECT_EQ(frame->frame.attributes, static_cast<std::uint32_t>(sph::kFrameVelocity));
  EXPECT_EQ(channels_.board.read().report.full_frame_bytes, 8U * 28U) << "at the capacity of the scene";
  ask(dds::SetOutput{{}, sph::kFrameVelocity | sph::kFrameDensity});
  EXPECT_EQ(channels_.board.read().report.full_frame_bytes, 8U * 32U);
  const dds::Reply refused = ask(dds::SetOutput{{}, sph::kFrameViscosity});
  EXPECT_EQ(refused.code, dds::ReplyCode::unsupported);
  EXPECT_THAT(refused.reason, HasSubstr("no viscosity effect"));
}

TEST_F(SimulationTest, RunsAtTheFactorAskedFor) {
  start(kRealTime);
  ask(dds::SetPace{{dds::PaceMode::factor, 2.0}});
  now_ += milliseconds{100};
  ticks(1000);
  EXPECT_NEAR(simulation_->world().time(), 0.2, 5e-3);
}

TEST_F(SimulationTest, StopsOnShutdownWithAReply) {
  start();
  push(dds::ShutdownSession{});
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::stop);
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted);
}

TEST_F(SimulationTest, EndsAfterItsDurationWithALastFrame) {
  start({{dds::PaceMode::maximum, 1.0}, {}, 0.0305});
  while (tick().kind != Simulation::Next::Kind::stop) ASSERT_LT(simulation_->world().stepCount(), 40U);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame.step, 31U);
}

TEST_F(SimulationTest, RunsOnAThreadUntilItIsStopped) {
  start();
  std::thread thread{[this] { simulation_->run(); }};
  while (channels_.frames.load() == nullptr) channels_.publisher.wait({});
  simulation_->requestStop();
  thread.join();
  SUCCEED();
}

TEST_F(SimulationTest, ShowsAFaultAndRecoversByReset) {
  log_->fail_at_step = 6;
  start();
  ticks(10);
  EXPECT_EQ(simulation_->world().stepCount(), 5U);
  const dds::StatusReport status = channels_.board.read().report;
  EXPECT_EQ(status.state, dds::SessionState::faulted);
  EXPECT_THAT(status.text, HasSubstr("particle 1 is not finite"));
  EXPECT_EQ(ask(dds::ResumeSession{}).code, dds::ReplyCode::state);
  EXPECT_EQ(ask(sph::AddWound{}).code, dds::ReplyCode::state);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<dds::Decision>(entries[0].input));

  log_->fail_at_step = 0;
  push(dds::ResetSession{});
  tick();
  loadUntilDone();
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted);
  EXPECT_EQ(simulation_->state(), dds::SessionState::running);
}

}  // namespace
}  // namespace bleedsim::daemon
