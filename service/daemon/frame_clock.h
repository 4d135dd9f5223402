// Which states become frames: the first one at or after each k/rate of simulated time. Time steps never depend on it.
#pragma once

#include <cmath>
#include <cstdint>

namespace bleedsim::daemon {

class FrameClock {
 public:
  explicit FrameClock(double rate) : rate_{rate} {}

  double rate() const { return rate_; }

  /// From the state at `sim_time` on, frames follow the multiples of 1/rate that lie after it.
  void setRate(double rate, double sim_time) {
    rate_ = rate;
    skipTo(sim_time);
  }
  /// The state at simulated time 0 is a frame.
  void restart() { next_ = 0; }

  /// Whether the state at `sim_time` is a frame; then the next is due one period later at least.
  bool take(double sim_time) {
    if (sim_time < due()) return false;
    skipTo(sim_time);
    return true;
  }

 private:
  double due() const { return static_cast<double>(next_) / rate_; }
  void skipTo(double sim_time) {
    next_ = static_cast<std::uint64_t>(std::floor(sim_time * rate_));
    while (due() <= sim_time) ++next_;
  }

  double rate_;
  std::uint64_t next_ = 0;
};

}  // namespace bleedsim::daemon
