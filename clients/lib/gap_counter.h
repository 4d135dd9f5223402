// Counts missing numbers of a stream; a new session identity starts afresh.
#pragma once

#include <cstdint>

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
  /// Told of a number by somebody else: it was sent, whether or not it comes.
  void told(const Uuid& session, std::uint64_t seq) {
    if (told_ == 0 || session != told_session_) {
      told_session_ = session;
      before_told_ = seq - 1;
    }
    told_ = seq;
  }
  std::uint64_t gaps() const { return gaps_; }
  /// Numbers told of beyond the last one that came.
  std::uint64_t overdue() const {
    const std::uint64_t came = started_ && session_ == told_session_ ? last_ : before_told_;
    return told_ > came ? told_ - came : 0;
  }

 private:
  bool started_ = false;
  Uuid session_{};
  std::uint64_t last_ = 0;
  std::uint64_t gaps_ = 0;
  Uuid told_session_{};
  std::uint64_t told_ = 0;
  std::uint64_t before_told_ = 0;  // until something comes, what was sent before is none of ours
};

}  // namespace bleedsim::client
