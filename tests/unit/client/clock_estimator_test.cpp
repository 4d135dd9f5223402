#include "clients/lib/clock_estimator.h"

#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::client {
namespace {

TEST(ClockEstimator, HasNothingBeforeTheFirstPing) { EXPECT_FALSE(ClockEstimator{}.best().has_value()); }

TEST(ClockEstimator, FindsTheOffsetOfASymmetricRoundTrip) {
  ClockEstimator clock;
  // The service's clock is 5000 ahead; 100 each way, 30 in the service.
  ASSERT_TRUE(clock.add(1000, 6100, 6130, 1230));
  EXPECT_EQ(clock.best()->offset_ns, 5000);
  EXPECT_EQ(clock.best()->round_trip_ns, 200);
}

TEST(ClockEstimator, TrustsTheShortestRoundTrip) {
  ClockEstimator clock;
  ASSERT_TRUE(clock.add(0, 5900, 5900, 1000));  // 900 there, 100 back: off by 400
  ASSERT_TRUE(clock.add(2000, 7050, 7050, 2100));
  ASSERT_TRUE(clock.add(3000, 8100, 8100, 3900));
  EXPECT_EQ(clock.best()->offset_ns, 5000);
  EXPECT_EQ(clock.best()->round_trip_ns, 100);
  EXPECT_EQ(clock.best()->samples, 3U);
}

TEST(ClockEstimator, ForgetsWhatLeftTheWindow) {
  ClockEstimator clock;
  ASSERT_TRUE(clock.add(0, 10, 10, 20));  // offset 0, the best for now
  for (std::size_t i = 0; i < ClockEstimator::kWindow; ++i) ASSERT_TRUE(clock.add(1000, 1600, 1600, 1200));  // offset 500
  EXPECT_EQ(clock.best()->offset_ns, 500);
  EXPECT_EQ(clock.best()->samples, ClockEstimator::kWindow);
}

TEST(ClockEstimator, RefusesStampsThatRunBackwardsOrWouldOverflow) {
  ClockEstimator clock;
  EXPECT_FALSE(clock.add(100, 50, 60, 90));
  EXPECT_FALSE(clock.add(100, 60, 50, 200));
  EXPECT_FALSE(clock.add(100, 50, 500, 200));
  EXPECT_FALSE(clock.add(0, std::numeric_limits<std::int64_t>::min(), 0, 10));
  EXPECT_FALSE(clock.add(0, 0, std::numeric_limits<std::int64_t>::max(), 10));
  EXPECT_FALSE(clock.best().has_value());
}

}  // namespace
}  // namespace bleedsim::client
