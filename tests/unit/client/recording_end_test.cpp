#include "clients/lib/recording_end.h"

#include <gtest/gtest.h>

namespace bleedsim::client {
namespace {

constexpr std::int64_t kNow = 5'000'000'000;
constexpr std::int64_t kGrace = RecordingEnd::kGraceNs;

/// Frames 1 and 2 at steps 10 and 20 of epoch 3, with their statistics.
RecordingEnd running() {
  RecordingEnd end;
  for (std::uint64_t seq = 1; seq <= 2; ++seq) {
    end.frame(seq, {3, 10 * seq});
    end.stats(seq);
  }
  return end;
}

TEST(RecordingEnd, GoesOnUntilThereIsAReason) {
  RecordingEnd end = running();
  end.status({3, 20});
  EXPECT_FALSE(end.over(kNow));
  EXPECT_FALSE(end.over(kNow + 100 * kGrace));
  EXPECT_TRUE(end.wantsFrames());
  EXPECT_FALSE(end.sessionGone());
}

TEST(RecordingEnd, AStoppedSessionIsOverAtOnceWhenItsLastStatusIsThatOfTheLastFrame) {
  RecordingEnd end = running();
  end.status({3, 20});
  end.stopped();
  EXPECT_TRUE(end.over(kNow));
  EXPECT_TRUE(end.sessionGone());
  EXPECT_EQ(end.missingUntil(), 0U);
}

TEST(RecordingEnd, WaitsForTheFrameThatTheStatisticsToldOf) {
  RecordingEnd end = running();
  end.stats(3);
  end.status({3, 30});
  end.stopped();
  EXPECT_FALSE(end.over(kNow));
  EXPECT_TRUE(end.wantsFrames()) << "frames are resent after the last status";
  end.frame(3, {3, 30});
  EXPECT_TRUE(end.over(kNow + 1));
  EXPECT_EQ(end.missingUntil(), 0U);
}

TEST(RecordingEnd, WaitsForTheStatisticsOfTheLastFrame) {
  RecordingEnd end = running();
  end.frame(3, {3, 30});
  end.status({3, 30});
  end.stopped();
  EXPECT_FALSE(end.over(kNow));
  EXPECT_TRUE(end.wantsStats(3));
  end.stats(3);
  EXPECT_TRUE(end.over(kNow + 1));
}

TEST(RecordingEnd, AStoppedSessionThatRanOnAfterTheLastFrameIsOverWithItsWritersOrTheGrace) {
  for (const bool gone : {true, false}) {
    RecordingEnd end = running();
    end.status({3, 25});
    end.stopped();
    EXPECT_FALSE(end.over(kNow));
    EXPECT_FALSE(end.over(kNow + kGrace - 1));
    if (gone) end.writersGone();
    EXPECT_EQ(end.over(kNow + kGrace - 1), gone);
    EXPECT_TRUE(end.over(kNow + kGrace));
  }
}

TEST(RecordingEnd, AFrameThatNeverCameIsMissing) {
  for (const bool lost : {true, false}) {
    RecordingEnd end = running();
    end.stats(5);
    lost ? end.lost() : end.stopped();
    EXPECT_EQ(end.over(kNow), lost);
    EXPECT_TRUE(end.over(kNow + kGrace));
    EXPECT_EQ(end.missingUntil(), 5U);
  }
  RecordingEnd without_frames;
  without_frames.stats(5);
  without_frames.lost();
  EXPECT_EQ(without_frames.missingUntil(), 0U) << "nobody knows that frames were asked for in time";
}

TEST(RecordingEnd, EnoughWaitsForTheStatisticsAndTheInputsOfTheLastFrame) {
  RecordingEnd end = running();
  end.frame(3, {3, 30});
  end.status({3, 29});
  end.enough();
  EXPECT_FALSE(end.wantsFrames());
  EXPECT_TRUE(end.wantsStats(3));
  EXPECT_FALSE(end.wantsStats(4));
  EXPECT_FALSE(end.over(kNow));
  end.stats(3);
  EXPECT_FALSE(end.over(kNow + 1)) << "inputs of the last frame may follow its statistics";
  end.status({3, 30});
  EXPECT_TRUE(end.over(kNow + 2));
  EXPECT_FALSE(end.sessionGone());
}

TEST(RecordingEnd, TheNextFramesStatisticsFollowTheInputsOfTheLast) {
  RecordingEnd end = running();
  end.enough();
  EXPECT_FALSE(end.over(kNow));
  end.stats(3);
  EXPECT_TRUE(end.over(kNow + 1));
  EXPECT_EQ(end.missingUntil(), 0U) << "frame 3 was not wanted";
}

TEST(RecordingEnd, EnoughWaitsNoLongerThanTheGrace) {
  RecordingEnd end = running();
  end.enough();
  EXPECT_FALSE(end.over(kNow));
  EXPECT_TRUE(end.over(kNow + kGrace));
}

TEST(RecordingEnd, AStatusOfAnEarlierEpochIsEarlier) {
  RecordingEnd end = running();
  end.status({2, 1000});
  end.enough();
  EXPECT_FALSE(end.over(kNow));
  end.status({4, 0});
  EXPECT_TRUE(end.over(kNow));
}

TEST(RecordingEnd, WithoutAFrameEnoughIsOverAtOnce) {
  RecordingEnd end;
  end.enough();
  EXPECT_TRUE(end.over(kNow));
}

}  // namespace
}  // namespace bleedsim::client
