#include "service/daemon/frame_clock.h"

#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

TEST(FrameClock, TakesTheFirstStateAtOrAfterEachMultiple) {
  FrameClock clock{60.0};
  EXPECT_TRUE(clock.take(0.0));
  EXPECT_FALSE(clock.take(0.016));
  EXPECT_TRUE(clock.take(1.0 / 60.0));
  EXPECT_FALSE(clock.take(0.0333));
  EXPECT_TRUE(clock.take(0.0334));
}

TEST(FrameClock, LeavesOutPeriodsThatOneStepJumpedOver) {
  FrameClock clock{60.0};
  EXPECT_TRUE(clock.take(0.1));
  EXPECT_FALSE(clock.take(0.101));
  EXPECT_TRUE(clock.take(7.0 / 60.0));
}

TEST(FrameClock, CountsExactlyOverALongTime) {
  FrameClock clock{60.0};
  int frames = 0;
  for (int i = 0; i <= 600'000; ++i) frames += clock.take(i * 1e-3) ? 1 : 0;
  EXPECT_EQ(frames, 36'001);
}

TEST(FrameClock, AnotherRateStartsAfterThePresentState) {
  FrameClock clock{10.0};
  clock.take(0.0);
  clock.setRate(100.0, 0.055);
  EXPECT_FALSE(clock.take(0.059));
  EXPECT_TRUE(clock.take(0.0601));
  clock.restart();
  EXPECT_TRUE(clock.take(0.0));
}

}  // namespace
}  // namespace bleedsim::daemon
