// What the intake hands to the simulation thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

#include "service/daemon/fair_queue.h"
#include "service/daemon/wakeup.h"
#include "service/dds/request.h"

namespace bleedsim::daemon {

struct InstrumentInput {
  dds::InstrumentSample sample;
  TimePoint received;  ///< its expiry counts from here
};
/// A writer of instrument samples or of requests is gone.
struct WriterLost {
  std::uint64_t writer = 0;
};
using Input = std::variant<dds::DecodedRequest, InstrumentInput, WriterLost>;

/// Bounded and fair between the writers on the wire: what a writer has no room for is refused, and whoever pushed it answers
/// "busy" or counts the loss.
class CommandQueue {
 public:
  static constexpr std::size_t kCapacity = 1024;

  explicit CommandQueue(std::size_t capacity = kCapacity) : queue_{capacity} {}

  /// Wakes the simulation thread. Moves from `input` only if there is room.
  bool tryPush(Input&& input) {
    const std::uint64_t writer = writerOf(input);
    const bool pushed = queue_.tryPush(writer, std::move(input));
    wakeup_.notify();
    return pushed;
  }
  bool tryPop(Input& out) { return queue_.tryPop(out); }
  bool empty() const { return queue_.empty(); }

  /// The simulation thread waits here.
  Wakeup& wakeup() { return wakeup_; }

 private:
  static std::uint64_t writerOf(const Input& input) {
    if (const auto* request = std::get_if<dds::DecodedRequest>(&input)) return request->writer;
    if (const auto* sample = std::get_if<InstrumentInput>(&input)) return sample->sample.writer;
    return std::get<WriterLost>(input).writer;
  }

  FairQueue<Input> queue_;
  Wakeup wakeup_;
};

}  // namespace bleedsim::daemon
