// The service manager that started this process: systemd, by sd_notify(3).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "service/daemon/wakeup.h"

namespace bleedsim::daemon {

struct ServiceManager {
  std::function<void(const std::string&)> tell;  ///< lines as READY=1, with '\n' between them; empty: nobody listens
  std::optional<Clock::duration> watchdog;       ///< the longest silence that it takes
};

/// From $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID. A failure to tell is logged once.
ServiceManager findServiceManager();

}  // namespace bleedsim::daemon
