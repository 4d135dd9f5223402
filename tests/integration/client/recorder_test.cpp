// The recorder in this process, where the middleware can be taken away from it.
#include "bleedsim/recorder.h"

#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

#include "service/recording/summary.h"
#include "tests/integration/client/client_fixture.h"

namespace bleedsim::client_test {
namespace {

using namespace std::chrono_literals;
using client::Recorder;

class RecorderTest : public ClientFixture {
 protected:
  void SetUp() override {
    ClientFixture::SetUp();
    service_ = serve("one");
    service_->publishScene("round_wound");
    ASSERT_TRUE(client_->find("one", kLong).ok());
    file_ = std::filesystem::path{testing::TempDir()} / fmt::format("bleedsim_recorder_{}.mcap", getpid());
  }
  void TearDown() override { std::filesystem::remove(file_); }

  /// Takes the middleware away from the client; the service keeps its own.
  void deleteClientsParticipant() const {
    std::array<dds_entity_t, 16> found{};
    const dds_return_t count = dds_lookup_participant(kDomain, found.data(), found.size());
    ASSERT_EQ(count, 2);
    for (std::size_t i = 0; i < 2; ++i) {
      if (found[i] != participant_->handle()) { ASSERT_EQ(dds_delete(found[i]), DDS_RETCODE_OK); }
    }
  }

  /// A recording that has one frame.
  std::optional<Recorder> startWithAFrame(const client::RecordingLimits& limits) {
    auto recorder = Recorder::start(*client_, "one", file_.string(), limits);
    EXPECT_TRUE(recorder.ok()) << recorder.status().message();
    EXPECT_TRUE(service_->waitFrameReaders(1));
    EXPECT_TRUE(service_->publishFrame(1).ok());
    EXPECT_TRUE(waitFor(*recorder, [](const client::RecordingProgress& progress) { return progress.frames == 1; }));
    return std::move(*recorder);
  }
  template <class Condition>
  static bool waitFor(Recorder& recorder, Condition holds) {
    const auto deadline = std::chrono::steady_clock::now() + kLong;
    while (!holds(recorder.progress()) && std::chrono::steady_clock::now() < deadline) {
      if (recorder.waitDone(1ms)) break;
    }
    return holds(recorder.progress());
  }
  recording::RecordingSummary summary() const {
    auto reader = recording::RecordingReader::open(file_);
    EXPECT_TRUE(reader.ok()) << reader.status().message();
    return *recording::summarize(*reader);
  }

  std::unique_ptr<FakeService> service_;
  std::filesystem::path file_;
};

TEST_F(RecorderTest, AFailureOfTheMiddlewareIsNoFailureOfTheFile) {
  auto recorder = startWithAFrame({.frames = 1000});
  // The participant goes while nothing is read: a sample on loan would go with it.
  deleteClientsParticipant();
  EXPECT_TRUE(recorder->waitDone(kLong));
  const Status closed = recorder->close();
  EXPECT_EQ(closed.code(), StatusCode::unavailable) << closed.message();
  EXPECT_THAT(closed.message(), testing::HasSubstr("the middleware failed"));
  auto reader = recording::RecordingReader::open(file_);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  EXPECT_FALSE(reader->truncated());
}

TEST_F(RecorderTest, WhatIsResentAfterTheLastStatusIsRecorded) {
  auto recorder = startWithAFrame({});
  service_->step = 20;
  service_->publishStatus(bleed_v1_STATE_STOPPED);
  ASSERT_TRUE(waitFor(*recorder, [](const client::RecordingProgress& progress) { return progress.session_gone; }));
  ASSERT_TRUE(service_->publishStats(2).ok());
  ASSERT_TRUE(service_->publishBareFrame(2).ok());
  EXPECT_TRUE(recorder->waitDone(kLong));
  EXPECT_TRUE(recorder->close().ok());
  EXPECT_EQ(summary().frames, 2U);
  EXPECT_EQ(summary().frame_stats, 2U);
  EXPECT_EQ(summary().gaps, 0U);
}

TEST_F(RecorderTest, StatisticsResentAfterTheLimitAreRecorded) {
  auto recorder = startWithAFrame({.frames = 2});
  ASSERT_TRUE(service_->publishBareFrame(2).ok());
  ASSERT_TRUE(waitFor(*recorder, [](const client::RecordingProgress& progress) { return progress.complete; }));
  service_->publishStatus();
  ASSERT_TRUE(service_->publishStats(2).ok());
  EXPECT_TRUE(recorder->waitDone(kLong));
  EXPECT_TRUE(recorder->close().ok());
  EXPECT_EQ(summary().frames, 2U);
  EXPECT_EQ(summary().frame_stats, 2U);
}

TEST_F(RecorderTest, InputsOfTheLastFrameAreRecordedThoughTheLimitIsReached) {
  auto recorder = startWithAFrame({.frames = 2});
  ASSERT_TRUE(service_->publishFrame(2).ok());
  ASSERT_TRUE(waitFor(*recorder, [](const client::RecordingProgress& progress) { return progress.complete; }));
  ASSERT_TRUE(service_->publishJournal(1, 20).ok());
  service_->publishStatus();
  EXPECT_TRUE(recorder->waitDone(kLong));
  EXPECT_TRUE(recorder->close().ok());
  EXPECT_EQ(summary().journal_entries, 1U);
}

TEST_F(RecorderTest, ALaterDaemonIsAReplacement) {
  auto recorder = startWithAFrame({});
  const auto later = FakeService::start(*participant_, "one");
  ASSERT_TRUE(later.ok());
  (*later)->start_stamp_ns = service_->start_stamp_ns + 1;
  (*later)->publishStatus();
  EXPECT_TRUE(waitFor(*recorder, [](const client::RecordingProgress& progress) { return progress.replaced; }));
  EXPECT_FALSE(recorder->progress().session_gone) << "the daemon that is recorded still lives";
}

TEST_F(RecorderTest, AFullDiskIsAFailureOfTheFile) {
  const auto recorder = Recorder::start(*client_, "one", "/dev/full", {});
  EXPECT_EQ(recorder.status().code(), StatusCode::io);
}

TEST_F(RecorderTest, AMiddlewareThatRefusesReadersIsNoFailureOfTheFile) {
  deleteClientsParticipant();
  const auto recorder = Recorder::start(*client_, "one", file_.string(), {});
  EXPECT_EQ(recorder.status().code(), StatusCode::unavailable) << recorder.status().message();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace bleedsim::client_test
