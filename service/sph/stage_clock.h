// Wall time spent in each stage of World::step.
#pragma once

#include <array>
#include <chrono>

#include "service/sph/world.h"

namespace bleedsim::sph {

class StageClock {
 public:
  void start() { last_ = Clock::now(); }
  /// What passed since start() or the last lap belongs to `stage`.
  void lap(Stage stage) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  /// Of what passed, `part` belongs to `second`, the rest to `first`.
  void lap(Stage first, Stage second, double part) {
    const double before = seconds_[static_cast<std::size_t>(first)];
    lap(first);
    const double moved = part * (seconds_[static_cast<std::size_t>(first)] - before);
    seconds_[static_cast<std::size_t>(first)] -= moved;
    seconds_[static_cast<std::size_t>(second)] += moved;
  }
  /// Of all time so far, 0 to 1.
  double part(Stage stage) const {
    double all = 0.0;
    for (const double seconds : seconds_) all += seconds;
    return all > 0.0 ? seconds_[static_cast<std::size_t>(stage)] / all : 0.0;
  }
  const std::array<double, static_cast<int>(Stage::count)>& seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_{};
  std::array<double, static_cast<int>(Stage::count)> seconds_{};
};

}  // namespace bleedsim::sph
