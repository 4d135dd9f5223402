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

/// Bounded to dds::kMaxClients. When one more comes, the sender that has most of them loses the one that was silent longest:
/// whoever makes up clients pushes out his own. A client that was forgotten starts again at zero. Safe from any thread; allocates
/// nothing.
class ClientLedger {
 public:
  /// A sample of `client` came at `now` (ns, CLOCK_MONOTONIC) from `sender`, see CommandQueue.
  void heard(const dds::Uuid& client, dds::ClientCount what, std::int64_t now, std::uint64_t sender) {
    const std::lock_guard lock{mutex_};
    dds::ClientActivity& entry = find(client, now, sender);
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
    std::transform(entries_.begin(), end(), out.begin(), [](const Entry& entry) { return entry.activity; });
    return count_;
  }

 private:
  struct Entry {
    dds::ClientActivity activity;
    std::uint64_t sender = 0;
  };
  using Entries = std::array<Entry, dds::kMaxClients>;

  Entries::iterator end() { return entries_.begin() + static_cast<std::ptrdiff_t>(count_); }
  Entries::const_iterator end() const { return entries_.begin() + static_cast<std::ptrdiff_t>(count_); }

  /// Null: it is none of those that are kept.
  dds::ClientActivity* known(const dds::Uuid& client) {
    const auto found =
        std::find_if(entries_.begin(), end(), [&client](const Entry& one) { return one.activity.client == client; });
    return found == end() ? nullptr : &found->activity;
  }
  dds::ClientActivity& find(const dds::Uuid& client, std::int64_t now, std::uint64_t sender) {
    if (dds::ClientActivity* entry = known(client)) return *entry;
    if (count_ == entries_.size()) forgetOne();
    entries_[count_] = {{client, {}, now}, sender};
    return entries_[count_++].activity;
  }
  void forgetOne() {
    const auto clients_of = [this](std::uint64_t sender) {
      return std::count_if(entries_.begin(), end(), [sender](const Entry& one) { return one.sender == sender; });
    };
    auto victim = entries_.begin();
    auto most = clients_of(victim->sender);
    for (auto one = std::next(victim); one != end(); ++one) {
      const auto clients = clients_of(one->sender);
      if (clients < most || (clients == most && one->activity.last_heard_ns >= victim->activity.last_heard_ns)) continue;
      victim = one;
      most = clients;
    }
    std::move(victim + 1, end(), victim);
    --count_;
  }

  mutable std::mutex mutex_;
  Entries entries_{};
  std::size_t count_ = 0;
};

}  // namespace bleedsim::daemon
