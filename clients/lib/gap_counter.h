// Counts missing numbers of a stream; a new session identity starts afresh.
#pragma once

#include <cstdint>
#include <cstring>

#include "bleedsim/types.h"

namespace bleedsim::client {

class GapCounter {
 public:
  /// Returns how many numbers are missing just before `seq`. A number that was passed already counts nothing.
  std::uint64_t note(const Uuid& session, std::uint64_t seq) {
    if (!started_ || session != session_) {
      started_ = true;
      session_ = session;
      last_ = seq;
      return 0;
    }
    if (seq <= last_) return 0;
    const std::uint64_t missing = seq - last_ - 1;
    last_ = seq;
    gaps_ += missing;
    return missing;
  }
  std::uint64_t gaps() const { return gaps_; }

 private:
  bool started_ = false;
  Uuid session_{};
  std::uint64_t last_ = 0;
  std::uint64_t gaps_ = 0;
};

}  // namespace bleedsim::client
