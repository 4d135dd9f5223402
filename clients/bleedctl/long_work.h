// Work on a file that takes a while.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <fmt/core.h>
#include <unistd.h>

#include "clients/bleedctl/stop_signal.h"

namespace bleedsim::bleedctl {

/// Shows how far it is on a terminal, and ends with a signal.
class LongWork {
 public:
  explicit LongWork(const char* unit) : unit_{unit} { holdStopSignals(); }
  /// False: a signal came.
  bool goOn(std::size_t done, std::size_t total) {
    if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r{} of {} {}\x1b[K{}", done, total, unit_, done == total ? "\n" : "");
    interrupted_ = interrupted_ || waitForStopSignal(std::chrono::milliseconds{0});
    return !interrupted_;
  }
  bool interrupted() const { return interrupted_; }

 private:
  const char* unit_;
  bool interrupted_ = false;
};

}  // namespace bleedsim::bleedctl
