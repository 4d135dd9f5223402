// The newest state on its way from the simulation thread to the publisher: three buffers, newest wins, nobody waits.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>

#include "service/dds/frame_snapshot.h"

namespace bleedsim::daemon {

/// One writer thread, one reader thread.
class FrameMailbox {
 public:
  using Buffers = std::array<std::unique_ptr<dds::FrameSnapshot>, 3>;

  /// Three snapshots with room for this many particles.
  static Buffers makeBuffers(std::uint32_t capacity);

  /// Writer: from now on states fill these buffers, made for another world. An unread state counts as overwritten.
  void renew(Buffers buffers);

  /// Writer: the snapshot to fill; null before the first renew().
  dds::FrameSnapshot* back() { return back_.get(); }
  /// Writer: hands the filled snapshot over. The one before counts as overwritten if it was not read.
  void store();

  /// Reader: the newest snapshot that was not read yet, or null. Valid until the next call.
  const dds::FrameSnapshot* load();

  std::uint64_t overwritten() const;

 private:
  std::unique_ptr<dds::FrameSnapshot> back_;   // of the writer
  std::unique_ptr<dds::FrameSnapshot> front_;  // of the reader
  mutable std::mutex mutex_;
  std::unique_ptr<dds::FrameSnapshot> middle_;     // guarded, like all below
  std::unique_ptr<dds::FrameSnapshot> new_front_;  // the reader takes it when it comes back for the next state
  bool fresh_ = false;
  std::uint64_t overwritten_ = 0;
};

}  // namespace bleedsim::daemon
