#include "service/daemon/pacer.h"

#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr TimePoint kStart{seconds{50}};
constexpr dds::Pace kRealTime{dds::PaceMode::real_time, 1.0};

TEST(Pacer, TellsHowFarAheadAStateIs) {
  const Pacer pacer{kRealTime, kStart};
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart + seconds{1}, 0.25), -0.75);
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{1}, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(pacer.behind(kStart, 0.25), 0.0);
}

TEST(Pacer, ScalesByTheFactor) {
  Pacer pacer{{dds::PaceMode::factor, 0.5}, kStart};
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{4}, 2.0), 0.5);
}

TEST(Pacer, OwesTimeForEver) {
  const Pacer pacer{kRealTime, kStart};
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{3600}, 1.0), 3599.0);
}

TEST(Pacer, NeverWaitsNorOwesAtMaximum) {
  Pacer pacer{{dds::PaceMode::maximum, 1.0}, kStart};
  EXPECT_EQ(pacer.secondsAhead(kStart, 100.0), 0.0);
  EXPECT_EQ(pacer.behind(kStart + seconds{100}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{2}, 6.0), 3.0);
}

TEST(Pacer, ShowsTheFactorOfTheLastSecond) {
  Pacer pacer{{dds::PaceMode::maximum, 1.0}, kStart};
  constexpr milliseconds kStep{30};
  TimePoint now = kStart;
  double time = 0.0;
  const auto run = [&](seconds duration, double factor) {
    double shown = 0.0;
    for (const TimePoint end = now + duration; now < end;) {
      now += kStep;
      time += factor * std::chrono::duration<double>{kStep}.count();
      shown = pacer.realTimeFactor(now, time);
    }
    return shown;
  };
  EXPECT_NEAR(run(seconds{600}, 3.0), 3.0, 1e-9);
  EXPECT_NEAR(run(seconds{2}, 0.25), 0.25, 1e-9) << "ten minutes before it do not count";
  pacer.pause(now, time);
  EXPECT_NEAR(pacer.realTimeFactor(now + seconds{50}, time), 0.25, 1e-9);
  pacer.resume(now + seconds{50}, time);
  now += seconds{50};
  EXPECT_NEAR(run(seconds{2}, 4.0), 4.0, 1e-9);
}

TEST(Pacer, CountsAStepLongerThanASecondAsAWhole) {
  Pacer pacer{kRealTime, kStart};
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{1}, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{2}, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{12}, 3.0), 0.1);
}

TEST(Pacer, StopsTheClockInAPause) {
  Pacer pacer{kRealTime, kStart};
  pacer.pause(kStart + seconds{1}, 1.0);
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{100}, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{100}, 1.0), 1.0);
  pacer.resume(kStart + seconds{101}, 1.0);
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart + seconds{101}, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{102}, 2.0), 1.0);
}

TEST(Pacer, LeavesStepsByHandOut) {
  Pacer pacer{kRealTime, kStart};
  pacer.pause(kStart + seconds{1}, 1.0);
  pacer.resume(kStart + seconds{2}, 6.0);
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart + seconds{2}, 6.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{3}, 7.0), 1.0);
}

TEST(Pacer, CarriesTheDebtOverAChangeOfFactor) {
  Pacer pacer{kRealTime, kStart};
  pacer.setPace({dds::PaceMode::factor, 2.0}, kStart + seconds{4}, 1.0);  // three simulated seconds are owed
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{4}, 1.0), 1.5);
  EXPECT_DOUBLE_EQ(pacer.realTimeFactor(kStart + seconds{5}, 4.0), 3.0) << "measured since the change";
  pacer.setPace({dds::PaceMode::maximum, 1.0}, kStart + seconds{5}, 4.0);
  pacer.setPace(kRealTime, kStart + seconds{6}, 9.0);
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{6}, 9.0), 0.0);
}

TEST(Pacer, ChangesPaceInAPause) {
  Pacer pacer{kRealTime, kStart};
  pacer.pause(kStart, 0.0);
  pacer.setPace({dds::PaceMode::factor, 2.0}, kStart + seconds{3}, 0.0);
  pacer.resume(kStart + seconds{9}, 0.0);
  EXPECT_DOUBLE_EQ(pacer.secondsAhead(kStart + seconds{9}, 2.0), 1.0);
}

TEST(Pacer, ARestartOwesNothing) {
  Pacer pacer{kRealTime, kStart};
  pacer.restart(kStart + seconds{10});
  EXPECT_DOUBLE_EQ(pacer.behind(kStart + seconds{10}, 0.0), 0.0);
  EXPECT_EQ(pacer.realTimeFactor(kStart + seconds{10}, 0.0), 0.0);
}

}  // namespace
}  // namespace bleedsim::daemon
