// Decides which frames of one daemon's stream a recording keeps. No DDS and no file in here.
#pragma once

#include <cmath>
#include <cstdint>

#include "bleedsim/recorder.h"

namespace bleedsim::client {

class RecordingWindow {
 public:
  explicit RecordingWindow(const RecordingLimits& limits) : limits_{limits} {}

  /// True: record the frame. Call it for each frame in order, until full().
  bool keep(std::uint32_t epoch, double sim_time_s) {
    if (!started_ || epoch != epoch_) {
      // Simulated time starts again at 0 with each epoch: what was recorded before counts on.
      before_s_ = recorded_s_;
      epoch_ = epoch;
      first_s_ = sim_time_s;
      next_ = 0.0;
      started_ = true;
    }
    const double since = sim_time_s - first_s_;
    constexpr double kTolerance = 1e-6;  // of a frame interval: times are sums of steps
    if (limits_.rate_hz) {
      const double index = since * *limits_.rate_hz + kTolerance;
      if (index < next_) return false;
      next_ = std::floor(index) + 1.0;
    }
    recorded_s_ = before_s_ + since;
    ++frames_;
    return true;
  }
  /// A limit is reached.
  bool full() const {
    constexpr double kToleranceS = 1e-9;
    return (limits_.frames && frames_ >= *limits_.frames) ||
           (limits_.duration_s && started_ && recorded_s_ >= *limits_.duration_s - kToleranceS);
  }
  double recordedSeconds() const { return recorded_s_; }

 private:
  RecordingLimits limits_;
  bool started_ = false;
  std::uint32_t epoch_ = 0;
  double first_s_ = 0.0;
  double next_ = 0.0;
  double before_s_ = 0.0;
  double recorded_s_ = 0.0;
  std::uint64_t frames_ = 0;
};

}  // namespace bleedsim::client
