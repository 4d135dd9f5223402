// How a thread shows that it goes on.
#pragma once

#include <atomic>
#include <cstdint>

namespace bleedsim::daemon {

/// Beaten by one thread at every turn of its loop, looked at by others.
class Pulse {
 public:
  void beat() { beats_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t beats() const { return beats_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> beats_{0};
};

}  // namespace bleedsim::daemon
