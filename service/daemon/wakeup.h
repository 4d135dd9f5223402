// How one thread of the service wakes another.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace bleedsim::daemon {

using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;

/// A flag with a bell: notifications given while nobody waits are kept until the next wait.
class Wakeup {
 public:
  void notify() {
    {
      const std::lock_guard lock{mutex_};
      raised_ = true;
    }
    bell_.notify_one();
  }

  /// Returns at a notification (true) or at the deadline (false); without a deadline only at a notification.
  bool wait(std::optional<TimePoint> deadline) {
    std::unique_lock lock{mutex_};
    const auto raised = [this] { return raised_; };
    if (deadline) {
      bell_.wait_until(lock, *deadline, raised);
    } else {
      bell_.wait(lock, raised);
    }
    const bool woken = raised_;
    raised_ = false;
    return woken;
  }

 private:
  std::mutex mutex_;
  std::condition_variable bell_;
  bool raised_ = false;
};

}  // namespace bleedsim::daemon
