// Watches from a thread of its own that the others go on, and tells the service manager.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "service/daemon/channels.h"
#include "service/daemon/service_manager.h"

namespace bleedsim::daemon {

/// Feeds the service manager's watchdog only while simulation and publisher go on. Each look wakes both of them, so that one that
/// waits for good reason, in a pause, while loading or ahead of its time, takes a turn and shows that it lives; one that hangs in
/// a step or on a lock does not, and the watchdog starves. A thread that stands still is also named in the log.
class Supervisor {
 public:
  /// Of a thread that stands still for this long, the log tells.
  static constexpr std::chrono::seconds kStandstill{5};

  Supervisor(Channels& channels, ServiceManager manager, TimePoint now);
  ~Supervisor() { stop(); }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  void start();
  /// Tells that the service ends.
  void stop();
  /// From any thread: clients can find the session.
  void sessionShown();

  /// One look; start() does it again and again, period() apart.
  void look(TimePoint now);
  Clock::duration period() const { return period_; }

 private:
  struct Watched {
    const char* name;
    const Pulse& pulse;
    Wakeup& wakeup;
    std::uint64_t beats = 0;
    TimePoint moved_at{};
    bool standing = false;  // and told so
  };

  void run();
  bool goesOn(Watched& watched, TimePoint now);
  void tellState(TimePoint now);
  void tell(const std::string& lines);

  Channels& channels_;
  ServiceManager manager_;
  Clock::duration period_;
  std::array<Watched, 2> watched_;
  std::atomic<bool> shown_{false};
  bool ready_told_ = false;
  dds::SessionState told_state_ = dds::SessionState::stopped;
  TimePoint next_state_{};
  std::atomic<bool> stop_requested_{false};
  Wakeup wakeup_;
  std::thread thread_;
};

}  // namespace bleedsim::daemon
