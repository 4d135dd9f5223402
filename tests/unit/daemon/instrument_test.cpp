#include <gmock/gmock.h>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using std::chrono::milliseconds;

TEST_F(SimulationTest, OnlyTheNewestSampleOfAToolActs) {
  start();
  ticks(4);
  for (std::uint64_t number = 1; number <= 3; ++number) ASSERT_TRUE(channels_.commands.tryPush(sample(number)));
  tick();
  ASSERT_EQ(log_->forces.size(), 1U);
  EXPECT_EQ(log_->forces.begin()->second.force.z(), 3.0);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].step, 4U);
  ticks(95);
  const dds::FrameSnapshot* frame = channels_.frames.load();
  ASSERT_NE(frame, nullptr);
  ASSERT_EQ(frame->instrument_count, 1U);
  EXPECT_EQ(frame->instruments[0].seq, 3U);
  EXPECT_EQ(frame->instruments[0].step, 5U);
}

TEST_F(SimulationTest, ASilentToolEndsAfterItsExpiry) {
  start();
  channels_.commands.tryPush(sample(1));
  tick();
  now_ += milliseconds{99};
  tick();
  EXPECT_EQ(log_->forces.size(), 1U);
  now_ += milliseconds{1};
  tick();
  EXPECT_TRUE(log_->forces.empty());
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_ended), 1U);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(std::get<dds::InstrumentEnded>(entries[1].input).reason, dds::InstrumentEndReason::expired);
}

TEST_F(SimulationTest, AToolAlsoEndsInAPause) {
  start();
  ask(dds::PauseSession{});
  channels_.commands.tryPush(sample(1));
  const Simulation::Next next = tick();
  ASSERT_EQ(next.kind, Simulation::Next::Kind::wait);
  ASSERT_TRUE(next.until.has_value());
  EXPECT_EQ(*next.until, now_ + milliseconds{100});
  now_ = *next.until;
  tick();
  EXPECT_TRUE(log_->forces.empty());
}

TEST_F(SimulationTest, AToolEndsWithItsWriter) {
  start();
  channels_.commands.tryPush(sample(1, 5, 0));
  channels_.commands.tryPush(sample(1, 6, 1));
  tick();
  ASSERT_EQ(log_->forces.size(), 2U);
  channels_.commands.tryPush(WriterLost{5});
  tick();
  EXPECT_EQ(log_->forces.size(), 1U);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 3U);
  const auto& ended = std::get<dds::InstrumentEnded>(entries[2].input);
  EXPECT_EQ(ended.reason, dds::InstrumentEndReason::lost);
  EXPECT_EQ(ended.key.tool, 0U);
}

TEST_F(SimulationTest, OlderSamplesAreDroppedUnlessTheClientStartedAgain) {
  start();
  channels_.commands.tryPush(sample(5));
  channels_.commands.tryPush(sample(4));
  tick();
  EXPECT_EQ(log_->forces.begin()->second.force.z(), 5.0);
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_dropped), 1U);
  channels_.commands.tryPush(sample(1, 77));
  tick();
  EXPECT_EQ(log_->forces.begin()->second.force.z(), 1.0);
}

TEST_F(SimulationTest, BoundsTheNumberOfTools) {
  start();
  const std::uint32_t half = dds::kMaxInstruments / 2;
  for (std::uint32_t tool = 0; tool < half + 3; ++tool) channels_.commands.tryPush(sample(1, 5, tool));
  tick();
  EXPECT_EQ(log_->forces.size(), half) << "one client leaves room for the others";
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_dropped), 3U);
  std::size_t held = half;
  for (std::uint8_t client = 20; client < 60; ++client) {
    for (std::uint32_t tool = 0; tool < half; ++tool) {
      InstrumentInput input = sample(1, client, tool);
      input.sample.key.client = dds::Uuid{client};
      channels_.commands.tryPush(std::move(input));
    }
    ticks(2);
    const std::size_t free = dds::kMaxInstruments - held;
    held += (free + 1) / 2;
    EXPECT_EQ(log_->forces.size(), held);
  }
  EXPECT_EQ(held, dds::kMaxInstruments);
}

TEST_F(SimulationTest, CountsTheSamplesThatNeverCame) {
  start();
  for (const std::uint64_t number : {10, 11, 15, 12}) channels_.commands.tryPush(sample(number));
  channels_.commands.tryPush(sample(1, 77));
  tick();
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_missed), 3U);
}

TEST_F(SimulationTest, CountsSamplesThatTheWorldRefuses) {
  start();
  channels_.commands.tryPush(sample(2000));
  tick();
  EXPECT_TRUE(log_->forces.empty());
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_refused), 1U);
  now_ += milliseconds{200};
  tick();
  EXPECT_TRUE(journal().empty()) << "what never acted does not end";
}

TEST_F(SimulationTest, AToolWhoseNewestSampleIsRefusedPushesNoLonger) {
  start();
  channels_.commands.tryPush(sample(1));
  tick();
  ASSERT_EQ(log_->forces.size(), 1U);
  for (std::uint64_t number = 2000; number < 2003; ++number) {
    channels_.commands.tryPush(sample(number));
    tick();
    EXPECT_TRUE(log_->forces.empty());
  }
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_refused), 3U);
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_ended), 1U);
  EXPECT_EQ(journal().size(), 2U) << "its push and its end; what was refused leaves no trace";
}

TEST_F(SimulationTest, AResetForgetsTheTools) {
  start();
  channels_.commands.tryPush(sample(1));
  tick();
  push(dds::ResetSession{});
  tick();
  loadUntilDone();
  journal();
  now_ += milliseconds{200};
  tick();
  EXPECT_TRUE(journal().empty());
}

}  // namespace
}  // namespace bleedsim::daemon
