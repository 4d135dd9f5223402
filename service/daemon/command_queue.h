// What the intake hands to the simulation thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <variant>
#include <vector>

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
  std::uint64_t sender = 0;
};
using Input = std::variant<dds::DecodedRequest, InstrumentInput, WriterLost>;

/// Bounded and fair between the senders, which are the DDS participants: a client that has many writers is still one, and one
/// that makes up identities, too. What a sender has no room for is refused, and whoever pushed it answers "busy" or counts the
/// loss. Scenes, each up to 1 MiB of text, have bounds of their own: one of a sender waits, kMaxScenes of all.
class CommandQueue {
 public:
  static constexpr std::size_t kCapacity = 1024;
  static constexpr std::size_t kMaxScenes = 8;

  explicit CommandQueue(std::size_t capacity = kCapacity) : queue_{capacity} { scenes_.reserve(kMaxScenes); }

  /// Wakes the simulation thread. Moves from `input` only if there is room.
  bool tryPush(Input&& input) {
    const std::uint64_t sender = senderOf(input);
    const bool scene = holdsScene(input);
    if (scene && !addScene(sender)) return false;
    const bool pushed = queue_.tryPush(sender, std::move(input));
    if (scene && !pushed) removeScene(sender);
    wakeup_.notify();
    return pushed;
  }
  bool tryPop(Input& out) {
    if (!queue_.tryPop(out)) return false;
    if (holdsScene(out)) removeScene(senderOf(out));
    return true;
  }
  bool empty() const { return queue_.empty(); }

  /// The simulation thread waits here.
  Wakeup& wakeup() { return wakeup_; }

 private:
  static std::uint64_t senderOf(const Input& input) {
    if (const auto* request = std::get_if<dds::DecodedRequest>(&input)) return request->sender;
    if (const auto* sample = std::get_if<InstrumentInput>(&input)) return sample->sample.sender;
    return std::get<WriterLost>(input).sender;
  }
  static bool holdsScene(const Input& input) {
    const auto* request = std::get_if<dds::DecodedRequest>(&input);
    return request != nullptr && std::holds_alternative<dds::LoadScene>(request->action);
  }
  bool addScene(std::uint64_t sender) {
    const std::lock_guard lock{mutex_};
    if (scenes_.size() == kMaxScenes || std::find(scenes_.begin(), scenes_.end(), sender) != scenes_.end()) return false;
    scenes_.push_back(sender);
    return true;
  }
  void removeScene(std::uint64_t sender) {
    const std::lock_guard lock{mutex_};
    scenes_.erase(std::find(scenes_.begin(), scenes_.end(), sender));
  }

  FairQueue<Input> queue_;
  std::mutex mutex_;
  std::vector<std::uint64_t> scenes_;  // the senders whose scene waits
  Wakeup wakeup_;
};

}  // namespace bleedsim::daemon
