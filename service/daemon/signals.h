// SIGINT and SIGTERM as calls on an ordinary thread.
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "service/status/status.h"

namespace bleedsim::daemon {

/// Takes SIGINT and SIGTERM of the whole process for as long as it lives. Make it before any other thread: threads inherit that
/// the signals are blocked.
class SignalWatch {
 public:
  static Result<std::unique_ptr<SignalWatch>> create();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// Calls `on_signal` for the first signal, one that came since create() included. A second signal ends the process at once.
  void start(std::function<void()> on_signal);
  void stop();

 private:
  SignalWatch(int signals, int end) : signals_{signals}, end_{end} {}
  void watch() const;

  int signals_;  // file descriptors
  int end_;
  std::function<void()> on_signal_;
  std::thread thread_;
};

}  // namespace bleedsim::daemon
