// A first-in first-out queue of fixed size between threads. After construction the queue itself allocates nothing.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace bleedsim::daemon {

template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : slots_(capacity) {}

  /// Moves from `value` only if there is room; `keep_free` slots are left to others.
  bool tryPush(T&& value, std::size_t keep_free = 0) {
    const std::lock_guard lock{mutex_};
    if (count_ + keep_free >= slots_.size()) return false;
    slots_[(first_ + count_) % slots_.size()] = std::move(value);
    ++count_;
    return true;
  }

  bool tryPop(T& out) {
    const std::lock_guard lock{mutex_};
    if (count_ == 0) return false;
    out = std::move(slots_[first_]);
    first_ = (first_ + 1) % slots_.size();
    --count_;
    return true;
  }

  std::size_t room() const {
    const std::lock_guard lock{mutex_};
    return slots_.size() - count_;
  }
  bool empty() const {
    const std::lock_guard lock{mutex_};
    return count_ == 0;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<T> slots_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace bleedsim::daemon
