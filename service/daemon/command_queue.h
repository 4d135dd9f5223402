// What the intake hands to the simulation thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

#include "service/daemon/bounded_queue.h"
#include "service/daemon/wakeup.h"
#include "service/dds/request.h"

namespace bleedsim::daemon {

struct InstrumentInput {
  dds::InstrumentSample sample;
  TimePoint received;  ///< its expiry counts from here
};
/// A writer of instrument samples is gone.
struct WriterLost {
  std::uint64_t writer = 0;
};
using Input = std::variant<dds::DecodedRequest, InstrumentInput, WriterLost>;

/// Bounded: a full queue refuses, and whoever pushed answers "busy" or counts the loss.
class CommandQueue {
 public:
  static constexpr std::size_t kCapacity = 1024;

  explicit CommandQueue(std::size_t capacity = kCapacity) : queue_{capacity} {}

  /// Wakes the simulation thread. Moves from `input` only if there is room.
  bool tryPush(Input&& input) {
    const bool pushed = queue_.tryPush(std::move(input));
    wakeup_.notify();
    return pushed;
  }
  bool tryPop(Input& out) { return queue_.tryPop(out); }
  bool empty() const { return queue_.empty(); }

  /// The simulation thread waits here.
  Wakeup& wakeup() { return wakeup_; }

 private:
  BoundedQueue<Input> queue_;
  Wakeup wakeup_;
};

}  // namespace bleedsim::daemon
