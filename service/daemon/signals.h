// SIGINT, SIGTERM and SIGHUP as calls on an ordinary thread.
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "service/status/status.h"

namespace bleedsim::daemon {

/// Takes SIGINT, SIGTERM and SIGHUP of the whole process for as long as it lives. Make it before any other thread: threads
/// inherit that the signals are blocked.
class SignalWatch {
 public:
  static Result<std::unique_ptr<SignalWatch>> create();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  struct Calls {
    std::function<void()> end;     ///< for the first SIGINT or SIGTERM; a second one ends the process at once, with exit code 1
    std::function<void()> hangup;  ///< for each SIGHUP; without it, SIGHUP is as SIGTERM
  };
  /// Calls for signals from now on, and for those that came since create().
  void start(Calls calls);
  void stop();

 private:
  SignalWatch(int signals, int end) : signals_{signals}, end_{end} {}
  void watch() const;

  int signals_;  // file descriptors
  int end_;
  Calls calls_;
  std::thread thread_;
};

}  // namespace bleedsim::daemon
