// Which daemon a recording belongs to: the one it began with, whoever takes the session's name later. No DDS in here.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "bleedsim/types.h"

namespace bleedsim::client {

struct KnownDaemon {
  Uuid session{};
  std::int64_t start_stamp_ns = 0;  ///< CLOCK_REALTIME when it started
};

class PinnedDaemon {
 public:
  /// `known`: the daemon to record; without it, the first one that is heard.
  explicit PinnedDaemon(const std::optional<KnownDaemon>& known) {
    if (!known) return;
    pinned_ = known->session;
    own_start_ns_ = known->start_stamp_ns;
  }

  /// Told the sender of each sample. True: it is the daemon of this recording.
  bool owns(const Uuid& sender) {
    if (!pinned_) pinned_ = sender;
    return sender == *pinned_;
  }
  /// Told the sender of each status and when it started: only a status says which of two daemons came later.
  void started(const Uuid& sender, std::int64_t start_stamp_ns) {
    if (owns(sender)) {
      own_start_ns_ = start_stamp_ns;
    } else {
      newest_other_ns_ = std::max(newest_other_ns_.value_or(start_stamp_ns), start_stamp_ns);
    }
  }
  /// Another daemon of the same session name, started later, has spoken. What a killed predecessor left in the readers is none.
  bool replaced() const { return own_start_ns_ && newest_other_ns_ && *newest_other_ns_ > *own_start_ns_; }

 private:
  std::optional<Uuid> pinned_;
  std::optional<std::int64_t> own_start_ns_;
  std::optional<std::int64_t> newest_other_ns_;
};

}  // namespace bleedsim::client
