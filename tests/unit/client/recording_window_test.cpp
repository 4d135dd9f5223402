#include "clients/lib/recording_window.h"

#include <gtest/gtest.h>

namespace bleedsim::client {
namespace {

/// Offers frames at `rate` Hz from time `start` until the window is full or `offered` have been; returns how many it kept.
int keepOf(RecordingWindow& window, double start, double rate, int offered, std::uint32_t epoch = 0) {
  int kept = 0;
  for (int i = 0; i < offered && !window.full(); ++i) {
    if (window.keep(epoch, start + i / rate)) ++kept;
  }
  return kept;
}

TEST(RecordingWindow, WithoutLimitsKeepsEverything) {
  RecordingWindow window{{}};
  EXPECT_FALSE(window.full());
  EXPECT_EQ(keepOf(window, 3.0, 60.0, 500), 500);
  EXPECT_FALSE(window.full());
}

TEST(RecordingWindow, CountsSimulatedTimeFromTheFirstFrame) {
  RecordingWindow window{{.duration_s = 5.0}};
  EXPECT_EQ(keepOf(window, 17.25, 60.0, 1000), 301) << "both ends of 5 s at 60 Hz";
  EXPECT_NEAR(window.recordedSeconds(), 5.0, 1e-9);
}

TEST(RecordingWindow, StopsAfterSoManyFrames) {
  RecordingWindow window{{.frames = 7}};
  EXPECT_EQ(keepOf(window, 0.0, 60.0, 100), 7);
}

TEST(RecordingWindow, AResetCountsOnFromWhatWasRecorded) {
  RecordingWindow window{{.duration_s = 2.0}};
  EXPECT_EQ(keepOf(window, 10.0, 10.0, 11), 11);
  EXPECT_FALSE(window.full());
  EXPECT_EQ(keepOf(window, 0.0, 10.0, 100, 1), 11);
  EXPECT_NEAR(window.recordedSeconds(), 2.0, 1e-9);
}

TEST(RecordingWindow, ThinsToTheRateWithoutDrift) {
  RecordingWindow slow{{.duration_s = 10.0, .rate_hz = 10.0}};
  EXPECT_EQ(keepOf(slow, 0.5, 60.0, 2000), 101);
  RecordingWindow uneven{{.duration_s = 10.0, .rate_hz = 25.0}};  // no divisor of 60
  EXPECT_EQ(keepOf(uneven, 0.5, 60.0, 2000), 251);
  RecordingWindow faster{{.rate_hz = 240.0}};
  EXPECT_EQ(keepOf(faster, 0.0, 60.0, 300), 300);
}

}  // namespace
}  // namespace bleedsim::client
