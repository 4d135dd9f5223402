#include "clients/bleedctl/record_narrator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bleedsim::bleedctl {
namespace {

using client::RecordingProgress;
using client::SessionState;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

RecordingProgress at(SessionState state, std::uint64_t frames = 0) { return {.frames = frames, .state = state}; }

TEST(RecordNarrator, TellsEachChangeOnce) {
  RecordNarrator narrator{"one", "a.mcap", false};
  EXPECT_EQ(narrator.news(at(SessionState::unknown)), "");
  EXPECT_THAT(narrator.news(at(SessionState::paused)), HasSubstr("session 'one' is paused"));
  EXPECT_EQ(narrator.news(at(SessionState::paused)), "");
  EXPECT_EQ(narrator.news(at(SessionState::unknown)), "");
  EXPECT_EQ(narrator.news(at(SessionState::running)), "session 'one' runs again, it is recorded\n");
  EXPECT_EQ(narrator.news(at(SessionState::running)), "");
  EXPECT_EQ(narrator.news(at(SessionState::running, 1)), "recording session 'one' into 'a.mcap'; Ctrl-C ends it\n");
  EXPECT_EQ(narrator.news(at(SessionState::running, 2)), "");
  EXPECT_THAT(narrator.news(at(SessionState::paused, 2)), HasSubstr("is paused"));
  EXPECT_EQ(narrator.news(at(SessionState::stopped, 2)), "");
}

TEST(RecordNarrator, PassesAWarningOnOnceForEachText) {
  RecordNarrator narrator{"one", "a.mcap", false};
  RecordingProgress progress = at(SessionState::running);
  progress.buffer_warning = "too small";
  EXPECT_EQ(narrator.news(progress), "warning: too small\n");
  EXPECT_EQ(narrator.news(progress), "");
  progress.buffer_warning = "far too small";
  EXPECT_EQ(narrator.news(progress), "warning: far too small\n");
}

TEST(RecordNarrator, ATerminalHasABarAndNewsOverIt) {
  RecordNarrator narrator{"one", "a.mcap", true};
  EXPECT_EQ(narrator.news(at(SessionState::running, 1)), "");
  EXPECT_THAT(narrator.news(at(SessionState::paused, 1)), AllOf(StartsWith("\r\x1b[Ksession 'one' is paused"), HasSubstr("\n")));
  EXPECT_THAT(narrator.bar(at(SessionState::paused, 30), {.frames = 60}), AllOf(StartsWith("\r[###"), HasSubstr(" 50 % ")));
  EXPECT_THAT(narrator.bar(at(SessionState::paused, 30), {}), StartsWith("\r0.00 s, 30 frames"));
  EXPECT_EQ((RecordNarrator{"one", "a.mcap", false}.bar(at(SessionState::running, 30), {.frames = 60})), "");
}

TEST(RecordNarrator, TellsWhatAHangingFileWaitsForAndTheWayOut) {
  const RecordNarrator narrator{"one", "a.mcap", false};
  EXPECT_EQ(narrator.closing("cannot write to 'a.mcap': full"),
            "cannot write to 'a.mcap': full: writing what is left; Ctrl-C gives it up\n");
  EXPECT_EQ(narrator.closing({}), "the disk takes its time for 'a.mcap': writing what is left; Ctrl-C gives it up\n");
  EXPECT_THAT((RecordNarrator{"one", "a.mcap", true}.closing({})), StartsWith("\r\x1b[Kthe disk"));
}

}  // namespace
}  // namespace bleedsim::bleedctl
