// What each client has sent, so that a person sees who floods a session, who sends nonsense and who has fallen silent.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>

#include "service/dds/session_report.h"

namespace bleedsim::daemon {

/// Bounded: the dds::kMaxClients that were heard of last. A client that was forgotten starts again at zero. Safe from any thread;
/// allocates nothing.
class ClientLedger {
 public:
  /// A sample of `client` came at `now` (ns, CLOCK_MONOTONIC).
  void heard(const dds::Uuid& client, dds::ClientCount what, std::int64_t now) {
    const std::lock_guard lock{mutex_};
    dds::ClientActivity& entry = find(client, now);
    entry.last_heard_ns = now;
    ++entry.counts[static_cast<std::size_t>(what)];
  }
  /// Something became of a sample that was heard. Nothing is noted of a client that is forgotten meanwhile.
  void note(const dds::Uuid& client, dds::ClientCount what) {
    const std::lock_guard lock{mutex_};
    if (dds::ClientActivity* entry = known(client)) ++entry->counts[static_cast<std::size_t>(what)];
  }

  /// In the order in which they were heard of first; returns how many there are.
  std::size_t read(std::span<dds::ClientActivity, dds::kMaxClients> out) const {
    const std::lock_guard lock{mutex_};
    std::copy_n(entries_.begin(), count_, out.begin());
    return count_;
  }

 private:
  /// Null: it is none of those that are kept.
  dds::ClientActivity* known(const dds::Uuid& client) {
    const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto found = std::find_if(entries_.begin(), end, [&client](const auto& entry) { return entry.client == client; });
    return found == end ? nullptr : &*found;
  }
  dds::ClientActivity& find(const dds::Uuid& client, std::int64_t now) {
    if (dds::ClientActivity* entry = known(client)) return *entry;
    const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(count_);
    if (count_ == entries_.size()) {
      const auto oldest =
          std::min_element(entries_.begin(), end, [](const auto& a, const auto& b) { return a.last_heard_ns < b.last_heard_ns; });
      std::move(oldest + 1, end, oldest);
      --count_;
    }
    entries_[count_] = {client, {}, now};
    return entries_[count_++];
  }

  mutable std::mutex mutex_;
  std::array<dds::ClientActivity, dds::kMaxClients> entries_{};
  std::size_t count_ = 0;
};

}  // namespace bleedsim::daemon
