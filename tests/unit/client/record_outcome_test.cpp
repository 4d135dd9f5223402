#include "clients/bleedctl/record_outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bleedsim::bleedctl {
namespace {

using client::RecordingLimits;
using client::RecordingProgress;
using client::SessionState;
using testing::HasSubstr;

const RecordingLimits kNoLimit;
const RecordingLimits kFrames{.frames = 10};

TEST(RecordOutcome, OnlyAFailingFileIsCalledFile) {
  struct Row {
    StatusCode failure;
    ExitCode code;
    const char* ended_by;
  };
  for (const Row& row : {Row{StatusCode::io, kFile, "file"}, Row{StatusCode::unavailable, kFailed, "middleware"},
                         Row{StatusCode::internal, kFailed, "error"}}) {
    for (const bool complete : {true, false}) {
      const RecordOutcome outcome = judgeRecording("one", {.complete = complete}, kFrames, {row.failure, "why"});
      EXPECT_EQ(outcome.code, row.code);
      EXPECT_STREQ(outcome.ended_by, row.ended_by);
      EXPECT_EQ(outcome.problem, "why");
    }
  }
  EXPECT_EQ(recordExitCode({StatusCode::invalid_argument, "frames"}), kUsage);
}

TEST(RecordOutcome, ALimitIsTheEndWhateverTheSessionDoesThen) {
  const RecordOutcome outcome = judgeRecording("one", {.complete = true, .session_gone = true}, kFrames, {});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_STREQ(outcome.ended_by, "limit");
}

TEST(RecordOutcome, TellsAShutdownALostDaemonAndAReplacedOneApart) {
  const RecordingProgress ended{.session_gone = true, .state = SessionState::stopped};
  EXPECT_EQ(judgeRecording("one", ended, kNoLimit, {}).code, kDone);
  EXPECT_EQ(judgeRecording("one", ended, kFrames, {}).code, kNoSession);
  const RecordingProgress lost{.session_gone = true, .state = SessionState::running};
  EXPECT_EQ(judgeRecording("one", lost, kNoLimit, {}).code, kNoSession);
  EXPECT_THAT(judgeRecording("one", lost, kNoLimit, {}).problem, HasSubstr("session 'one' is gone, its daemon was lost"));
  const RecordingProgress replaced{.session_gone = true, .replaced = true, .state = SessionState::running};
  EXPECT_THAT(judgeRecording("one", replaced, kNoLimit, {}).problem, HasSubstr("another daemon has taken its name"));
}

TEST(RecordOutcome, AnInterruptIsAFailureOnlyBeforeALimit) {
  EXPECT_EQ(judgeRecording("one", {}, kFrames, {}).code, kInterrupted);
  EXPECT_EQ(judgeRecording("one", {}, kNoLimit, {}).code, kDone);
  EXPECT_STREQ(judgeRecording("one", {}, kNoLimit, {}).ended_by, "interrupt");
}

}  // namespace
}  // namespace bleedsim::bleedctl
