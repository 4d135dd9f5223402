// Gaps of frames, and what makes a recording replayable.
#include <gtest/gtest.h>

#include "service/recording/seq_tracker.h"
#include "service/recording/text_check.h"

namespace bleedsim::recording::test {
namespace {

const SessionKey kA(16, 'a');
const SessionKey kB(16, 'b');

TEST(FrameTracker, CountsWhatIsMissing) {
  FrameTracker tracker;
  for (const std::uint64_t seq : {10U, 11U, 15U, 15U, 14U, 16U}) tracker.add(kA, 1, seq);
  EXPECT_EQ(tracker.missing(), 3U);
  ASSERT_EQ(tracker.ranges().size(), 1U);
  EXPECT_EQ(tracker.ranges().front(), std::make_pair(std::uint64_t{12}, std::uint64_t{14}));
}

TEST(FrameTracker, SessionsAndEpochsStartAfreshButSeqRunsOn) {
  FrameTracker tracker;
  tracker.add(kA, 1, 100);
  tracker.add(kB, 1, 5);
  tracker.add(kA, 2, 101);
  tracker.add(kB, 1, 6);
  EXPECT_EQ(tracker.missing(), 0U);
  tracker.add(kA, 3, 1);
  EXPECT_EQ(tracker.missing(), 0U);
  tracker.add(kA, 4, 4);
  EXPECT_EQ(tracker.missing(), 2U);
}

TEST(FrameTracker, FramesPublishedAfterTheLastOneAreMissing) {
  FrameTracker tracker;
  tracker.publishedUntil(kA, 7);
  EXPECT_EQ(tracker.missing(), 0U) << "none of its frames was ever there";
  tracker.add(kA, 1, 10);
  tracker.publishedUntil(kA, 10);
  tracker.publishedUntil(kA, 3);
  EXPECT_EQ(tracker.missing(), 0U);
  tracker.publishedUntil(kA, 12);
  tracker.publishedUntil(kA, 12);
  EXPECT_EQ(tracker.missing(), 2U);
  EXPECT_EQ(tracker.ranges().back(), std::make_pair(std::uint64_t{11}, std::uint64_t{12}));
}

TEST(ReplayCheck, NeedsSceneAndTheWholeJournal) {
  ReplayCheck check;
  EXPECT_EQ(check.reason(), "it holds no frames");
  check.addFrame(kA, 1);
  EXPECT_EQ(check.reason(), "the scene of epoch 1 is missing");
  check.addScene(kA, 1);
  EXPECT_EQ(check.reason(), "");
  check.addJournal(kA, 1, 1);
  check.addJournal(kA, 1, 2);
  check.addFrame(kA, 2);
  check.addJournal(kA, 2, 1);
  EXPECT_EQ(check.reason(), "");
  check.addJournal(kA, 2, 4);
  EXPECT_EQ(check.journalGaps(), 2U);
  EXPECT_EQ(check.reason(), "2 journal entries of epoch 2 are missing");
}

TEST(ReplayCheck, AJournalThatStartsLateIsAGap) {
  ReplayCheck check;
  check.addFrame(kA, 1);
  check.addScene(kA, 1);
  check.addJournal(kA, 1, 2);
  EXPECT_EQ(check.reason(), "1 journal entries of epoch 1 are missing");
}

TEST(ReplayCheck, NeedsEveryEntryThatAStateContains) {
  ReplayCheck check;
  check.addFrame(kA, 1);
  check.addScene(kA, 1);
  check.addState(kA, 1, 0);
  EXPECT_EQ(check.reason(), "");
  check.addState(kA, 1, 3);
  EXPECT_EQ(check.reason(), "3 journal entries of epoch 1 are missing");
  check.addJournal(kA, 1, 1);
  EXPECT_EQ(check.reason(), "2 journal entries of epoch 1 are missing");
  check.addJournal(kA, 1, 3);
  EXPECT_EQ(check.reason(), "1 journal entries of epoch 1 are missing");
}

TEST(ReplayCheck, NeedsTheStateThatAnEpochGoesOnFrom) {
  ReplayCheck check;
  check.addFrame(kA, 2);
  check.addScene(kA, 2);
  check.addJournal(kA, 2, 1);
  check.addRestored(kA, 2, kA, 1, 2);
  EXPECT_EQ(check.reason(), "the scene of epoch 1 is missing");
  check.addScene(kA, 1);
  EXPECT_EQ(check.reason(), "2 journal entries of epoch 1 are missing");
  check.addJournal(kA, 1, 1);
  check.addJournal(kA, 1, 2);
  EXPECT_EQ(check.reason(), "");
  check.addRestored(kA, 2, kB, 1, 2);
  EXPECT_EQ(check.reason(), "epoch 2 begins with a checkpoint of another session, which is not in the file");
}

TEST(ReplayCheck, OneSessionOnly) {
  ReplayCheck check;
  check.addScene(kA, 1);
  check.addScene(kB, 1);
  check.addFrame(kA, 1);
  check.addFrame(kB, 1);
  EXPECT_EQ(check.reason(), "it holds frames of more than one session");
}

TEST(Utf8, KnowsTheRules) {
  for (const char* good : {"", "abc", "\xc3\xa4", "\xe2\x82\xac", "\xf0\x9f\xa9\xb8"}) EXPECT_TRUE(isUtf8(good)) << good;
  for (const char* bad : {"\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "a\x80"}) EXPECT_FALSE(isUtf8(bad));
}

}  // namespace
}  // namespace bleedsim::recording::test
