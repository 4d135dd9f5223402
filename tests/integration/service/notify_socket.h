// The service manager's end of sd_notify(3): a datagram socket that hears what a daemon tells.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bleedsim::service_test {

/// While it lives, children of this process find it in $NOTIFY_SOCKET, with a watchdog of that time.
class NotifySocket {
 public:
  explicit NotifySocket(std::chrono::microseconds watchdog);
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Waits for a line that fits; nothing when none comes.
  std::optional<std::string> waitFor(const std::function<bool(const std::string&)>& fits);
  /// Waits for this very line.
  bool waitFor(const std::string& line);
  /// Every line so far.
  const std::vector<std::string>& heard() const { return heard_; }

 private:
  bool hearMore();

  std::string path_;
  int socket_ = -1;
  std::vector<std::string> heard_;
  std::size_t looked_at_ = 0;
};

}  // namespace bleedsim::service_test
