// A first-in first-out queue of fixed size that several senders share. Whoever floods it leaves room for the others and does not
// get in front of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

namespace bleedsim::daemon {

/// Values of one sender keep their order; senders take turns. A sender may hold as many values as there are free slots, so that
/// one alone fills half of the queue, two a third each, and there is always a slot for one that holds none (dynamic thresholds:
/// Choudhury and Hahne, IEEE/ACM Transactions on Networking 6, 1998). After construction the queue itself allocates nothing.
template <class T>
class FairQueue {
 public:
  explicit FairQueue(std::size_t capacity) : slots_(capacity) {
    lanes_.reserve(capacity);
    for (std::size_t i = 0; i < capacity; ++i) slots_[i].next = i + 1 < capacity ? i + 1 : kNone;
    free_ = capacity > 0 ? 0 : kNone;
  }

  /// Moves from `value` only if `sender` has room.
  bool tryPush(std::uint64_t sender, T&& value) {
    const std::lock_guard lock{mutex_};
    auto lane = std::find_if(lanes_.begin(), lanes_.end(), [sender](const Lane& other) { return other.sender == sender; });
    const std::size_t held = lane == lanes_.end() ? 0 : lane->count;
    if (held >= slots_.size() - count_) return false;
    const std::size_t slot = free_;
    free_ = slots_[slot].next;
    slots_[slot].value = std::move(value);
    slots_[slot].next = kNone;
    if (lane == lanes_.end()) {
      lanes_.push_back({sender, slot, slot, 0});
      lane = std::prev(lanes_.end());
    } else {
      slots_[lane->last].next = slot;
      lane->last = slot;
    }
    ++lane->count;
    ++count_;
    return true;
  }

  bool tryPop(T& out) {
    const std::lock_guard lock{mutex_};
    if (count_ == 0) return false;
    if (turn_ >= lanes_.size()) turn_ = 0;
    Lane& lane = lanes_[turn_];
    const std::size_t slot = lane.first;
    out = std::move(slots_[slot].value);
    lane.first = slots_[slot].next;
    slots_[slot].next = free_;
    free_ = slot;
    --count_;
    if (--lane.count == 0) {
      lanes_.erase(lanes_.begin() + static_cast<std::ptrdiff_t>(turn_));
    } else {
      ++turn_;
    }
    return true;
  }

  bool empty() const {
    const std::lock_guard lock{mutex_};
    return count_ == 0;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  struct Slot {
    T value{};
    std::size_t next = kNone;  // of the same lane, or of the free ones
  };
  struct Lane {
    std::uint64_t sender = 0;
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t count = 0;  // never 0: an empty lane is none
  };

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::vector<Lane> lanes_;
  std::size_t free_ = kNone;
  std::size_t turn_ = 0;
  std::size_t count_ = 0;
};

}  // namespace bleedsim::daemon
