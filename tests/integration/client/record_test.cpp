// How `bleedctl record` ends and what it says meanwhile, against fake services whose every sample is chosen.
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>

#include "tests/integration/client/bleedctl_fixture.h"
#include "tests/integration/client/json_value.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::client_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RecordTest : public BleedctlTest {
 protected:
  std::string file() const { return (folder_ / "a.mcap").string(); }
  std::vector<std::string> record(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"record", "-o", file()});
    return command(std::move(more));
  }
  Json info() const {
    const test::Finished finished = test::runProcess(command({"info", file(), "--json"}), false);
    EXPECT_EQ(finished.code, 0) << finished.output;
    return parseJson(finished.output);
  }
  /// What --json printed: the last line of an output that may hold lines of stderr before.
  static Json lastLine(const std::string& output) {
    const std::size_t before = output.size() < 2 ? std::string::npos : output.rfind('\n', output.size() - 2);
    return parseJson(before == std::string::npos ? output : output.substr(before + 1));
  }
  /// Records one frame of `count` particles; the recording goes on.
  static void recordFirst(FakeService& service, test::ChildProcess& recording, std::uint32_t count = 3) {
    ASSERT_TRUE(service.waitFrameReaders(1));
    ASSERT_TRUE(service.publishFrame(1, count).ok());
    const auto started = recording.readLine();
    ASSERT_TRUE(started.has_value());
    EXPECT_THAT(*started, HasSubstr("recording session 'one'"));
    service.publishStatus();  // tells the recording that no inputs of this frame follow
  }

  const test::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(RecordTest, SaysAtOnceThatThereIsNothingToRecordAndWhenThereIs) {
  const auto service = serve("one");
  for (const bool json : {false, true}) {
    service->publishStatus(bleed_v1_STATE_PAUSED);
    test::ChildProcess recording{record({"--frames", "2", json ? "--json" : "--timeout=20"}), true};
    const auto paused = recording.readLine();
    ASSERT_TRUE(paused.has_value());
    EXPECT_EQ(*paused, "session 'one' is paused: nothing is recorded until it resumes (bleedctl resume)\n");
    service->publishStatus(bleed_v1_STATE_FAULTED, "a particle is not finite");
    const auto faulted = recording.readLine();
    ASSERT_TRUE(faulted.has_value());
    EXPECT_THAT(*faulted, HasSubstr("faulted, a particle is not finite: nothing is recorded until a reset"));
    service->publishStatus(bleed_v1_STATE_LOADING);
    const auto loading = recording.readLine();
    ASSERT_TRUE(loading.has_value());
    EXPECT_THAT(*loading, HasSubstr("loading a scene"));
    service->publishStatus(bleed_v1_STATE_RUNNING);
    const auto running = recording.readLine();
    ASSERT_TRUE(running.has_value());
    EXPECT_EQ(*running, "session 'one' runs again, it is recorded\n");
    recordFirst(*service, recording);
    ASSERT_TRUE(service->publishFrame(2).ok());
    EXPECT_EQ(recording.wait(), 0) << recording.output();
    if (json) { EXPECT_EQ(number(lastLine(recording.output()), "frames"), 2.0); }
    ASSERT_TRUE(service->waitNoFrameReaders());
  }
}

TEST_F(RecordTest, PrintsOneJsonObjectAndNothingElseOnStdout) {
  const auto service = serve("one");
  service->publishStatus(bleed_v1_STATE_PAUSED);
  test::ChildProcess recording{record({"--frames", "1", "--json"}), false};
  ASSERT_TRUE(service->waitFrameReaders(1));
  service->publishStatus(bleed_v1_STATE_RUNNING);
  ASSERT_TRUE(service->publishFrame(1).ok());
  ASSERT_EQ(recording.wait(), 0);
  const Json printed = parseJson(recording.output());
  EXPECT_EQ(number(printed, "frames"), 1.0);
  EXPECT_TRUE(member(printed, "complete").bool_value());
  EXPECT_EQ(text(printed, "ended_by"), "limit");
}

TEST_F(RecordTest, AnInterruptBeforeTheLimitHasItsOwnCodeAndSaysSo) {
  const auto service = serve("one");
  for (const char* limit : {"--frames", "--duration"}) {
    test::ChildProcess recording{record({limit, "1000"}), true};
    recordFirst(*service, recording);
    recording.signal(SIGINT);
    EXPECT_EQ(recording.wait(), 130) << recording.output();
    EXPECT_THAT(recording.output(), AllOf(HasSubstr("1 frames, 0 gaps"), HasSubstr("; incomplete: interrupted"),
                                          HasSubstr("the recording is incomplete, '" + file() + "' holds what came")));
    EXPECT_EQ(number(info(), "frames"), 1.0);
    EXPECT_FALSE(member(info(), "truncated").bool_value());
    ASSERT_TRUE(service->waitNoFrameReaders());
  }
  test::ChildProcess recording{record({"--frames", "1000", "--json"}), false};
  ASSERT_TRUE(service->waitFrameReaders(1));
  recording.signal(SIGTERM);
  EXPECT_EQ(recording.wait(), 130);
  EXPECT_FALSE(member(parseJson(recording.output()), "complete").bool_value());
  EXPECT_EQ(text(parseJson(recording.output()), "ended_by"), "interrupt");
}

TEST_F(RecordTest, WithoutALimitAnInterruptOrAShutdownCompletesIt) {
  const auto service = serve("one");
  for (const bool interrupt : {true, false}) {
    test::ChildProcess recording{record({"--json"}), true};
    recordFirst(*service, recording);
    if (interrupt) {
      recording.signal(SIGINT);
    } else {
      service->publishStatus(bleed_v1_STATE_STOPPED);
    }
    EXPECT_EQ(recording.wait(), 0) << recording.output();
    const Json printed = lastLine(recording.output());
    EXPECT_TRUE(member(printed, "complete").bool_value());
    EXPECT_EQ(text(printed, "ended_by"), interrupt ? "interrupt" : "session");
    EXPECT_EQ(member(printed, "session_gone").bool_value(), !interrupt);
    ASSERT_TRUE(service->waitNoFrameReaders());
  }
}

TEST_F(RecordTest, AFrameThatNeverComesIsAGapAtTheEnd) {
  const auto service = serve("one");
  test::ChildProcess recording{record({"--json"}), true};
  recordFirst(*service, recording);
  ASSERT_TRUE(service->publishStats(3).ok());
  service->publishStatus(bleed_v1_STATE_STOPPED);
  EXPECT_EQ(recording.wait(), 0) << recording.output();
  EXPECT_EQ(number(lastLine(recording.output()), "frames"), 1.0);
  EXPECT_EQ(number(lastLine(recording.output()), "gaps"), 2.0);
  EXPECT_EQ(number(info(), "gaps"), 2.0);
}

class LostSessionTest : public RecordTest, public testing::WithParamInterface<bool> {};

TEST_P(LostSessionTest, IsAFailureWithAndWithoutALimit) {
  auto service = serve("one");
  test::ChildProcess recording{record(GetParam() ? std::vector<std::string>{"--duration", "1000"} : std::vector<std::string>{}),
                               true};
  recordFirst(*service, recording);
  service.reset();
  EXPECT_EQ(recording.wait(), 3) << recording.output();
  EXPECT_THAT(recording.output(), HasSubstr("session 'one' is gone, its daemon was lost: the recording is incomplete"));
  EXPECT_EQ(number(info(), "frames"), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Limits, LostSessionTest, testing::Bool());

TEST_F(RecordTest, AnotherDaemonOfTheSameNameNeverComesIntoTheFile) {
  auto first = serve("one");
  test::ChildProcess recording{record({"--frames", "1000"}), true};
  recordFirst(*first, recording, 3);
  const auto second = serve("one");
  ASSERT_TRUE(second->waitFrameReaders(1));
  for (std::uint64_t seq = 1; seq <= 5; ++seq) ASSERT_TRUE(second->publishFrame(seq, 7).ok());
  second->publishStatus(bleed_v1_STATE_STOPPED);  // its end is not that of the first one, either
  ASSERT_TRUE(first->publishFrame(2, 3).ok());
  ASSERT_TRUE(first->publishFrame(3, 3).ok());
  first->publishStatus(bleed_v1_STATE_STOPPED);
  EXPECT_EQ(recording.wait(), 3) << recording.output();
  EXPECT_THAT(recording.output(), HasSubstr("session 'one' ended: the recording is incomplete"));
  const Json figures = info();
  EXPECT_EQ(number(figures, "epochs"), 1.0) << "each daemon's frames count as epochs of their own";
  EXPECT_EQ(number(figures, "max_particles"), 3.0);
  EXPECT_EQ(number(figures, "gaps"), 0.0);
  EXPECT_GE(number(figures, "frames"), 1.0);
}

TEST_F(RecordTest, EndsWithItsDaemonThoughAnotherOneLives) {
  auto first = serve("one");
  test::ChildProcess recording{record(), true};
  recordFirst(*first, recording, 3);
  const auto second = serve("one");
  ASSERT_TRUE(second->waitFrameReaders(1));
  ASSERT_TRUE(second->publishFrame(1, 7).ok());
  first.reset();
  EXPECT_EQ(recording.wait(), 3) << recording.output();
  EXPECT_THAT(recording.output(), HasSubstr("session 'one' is gone"));
  EXPECT_EQ(number(info(), "frames"), 1.0);
  EXPECT_EQ(number(info(), "max_particles"), 3.0);
}

TEST_F(RecordTest, AnEarlierDaemonIsNoReplacement) {
  auto first = serve("one");
  test::ChildProcess recording{record(), true};
  recordFirst(*first, recording, 3);
  const auto second = FakeService::start(*participant_, "one");
  ASSERT_TRUE(second.ok());
  ASSERT_TRUE((*second)->waitFrameReaders(1));
  (*second)->start_stamp_ns = first->start_stamp_ns - 1;
  (*second)->publishStatus();
  ASSERT_TRUE((*second)->publishFrame(1, 7).ok());
  first.reset();
  EXPECT_EQ(recording.wait(), 3) << recording.output();
  EXPECT_THAT(recording.output(), HasSubstr("session 'one' is gone, its daemon was lost"));
  EXPECT_EQ(number(info(), "max_particles"), 3.0);
}

TEST_F(RecordTest, WarnsOfFramesThatNoReceiveBufferHolds) {
  const auto service = serve("one");
  service->capacity = 10'000'000;
  service->publishScene("huge");
  test::ChildProcess recording{record({"--frames", "1", "--json"}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(1).ok());
  EXPECT_EQ(recording.wait(), 0) << recording.output();
  EXPECT_THAT(recording.output(),
              AllOf(HasSubstr("warning: "), HasSubstr("two frames of this scene at full capacity need 320000 kB")));
  EXPECT_EQ(number(lastLine(recording.output()), "frames"), 1.0);
}

TEST_F(RecordTest, CountsMalformedFrames) {
  const auto service = serve("one");
  for (const bool json : {true, false}) {
    test::ChildProcess recording{record({"--frames", "2", json ? "--json" : "--timeout=20"}), false};
    ASSERT_TRUE(service->waitFrameReaders(1));
    ASSERT_TRUE(service->publishFrame(1).ok());
    ASSERT_TRUE(service->publishMalformedFrame(2).ok());
    ASSERT_TRUE(service->publishFrame(3).ok());
    ASSERT_EQ(recording.wait(), 0);
    if (json) {
      EXPECT_EQ(number(parseJson(recording.output()), "malformed"), 1.0);
      EXPECT_EQ(number(parseJson(recording.output()), "gaps"), 1.0);
    } else {
      EXPECT_THAT(recording.output(), AllOf(HasSubstr("2 frames, 1 gaps, 1 malformed"), Not(HasSubstr("incomplete"))));
    }
    ASSERT_TRUE(service->waitNoFrameReaders());
  }
}

}  // namespace
}  // namespace bleedsim::client_test
