// Which daemon a recording belongs to: the one it began with, whoever takes the session's name later. No DDS in here.
#pragma once

#include <optional>

#include "bleedsim/types.h"

namespace bleedsim::client {

class PinnedDaemon {
 public:
  /// `known`: the daemon to record; without it, the first one that is heard.
  explicit PinnedDaemon(const std::optional<Uuid>& known) : pinned_{known} {}

  /// Told the sender of each sample. True: it is the daemon of this recording.
  bool owns(const Uuid& sender) {
    if (!pinned_) pinned_ = sender;
    const bool own = sender == *pinned_;
    stranger_heard_ = stranger_heard_ || !own;
    return own;
  }
  /// Another daemon of the same session name has spoken.
  bool strangerHeard() const { return stranger_heard_; }

 private:
  std::optional<Uuid> pinned_;
  bool stranger_heard_ = false;
};

}  // namespace bleedsim::client
