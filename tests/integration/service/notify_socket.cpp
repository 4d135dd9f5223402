#include "tests/integration/service/notify_socket.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/support/child_process.h"

namespace bleedsim::service_test {

NotifySocket::NotifySocket(std::chrono::microseconds watchdog)
    : path_{std::filesystem::temp_directory_path() / ("bleedsim-notify-" + std::to_string(getpid()))} {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) throw std::runtime_error{"too long for a socket: " + path_};
  std::strcpy(address.sun_path, path_.c_str());
  std::filesystem::remove(path_);
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) throw std::runtime_error{"no " + path_};
  setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  setenv("WATCHDOG_USEC", std::to_string(watchdog.count()).c_str(), 1);
}

NotifySocket::~NotifySocket() {
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  close(socket_);
  std::filesystem::remove(path_);
}

bool NotifySocket::hearMore() {
  pollfd waited{socket_, POLLIN, 0};
  const auto patience = std::chrono::milliseconds{test::kPatience};
  if (poll(&waited, 1, static_cast<int>(patience.count())) <= 0) return false;
  std::array<char, 4096> buffer;
  const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
  if (count <= 0) return false;
  std::istringstream lines{std::string{buffer.data(), static_cast<std::size_t>(count)}};
  for (std::string line; std::getline(lines, line);) heard_.push_back(line);
  return true;
}

std::optional<std::string> NotifySocket::waitFor(const std::function<bool(const std::string&)>& fits) {
  for (;;) {
    while (looked_at_ < heard_.size()) {
      const std::string& line = heard_[looked_at_++];
      if (fits(line)) return line;
    }
    if (!hearMore()) return {};
  }
}

bool NotifySocket::waitFor(const std::string& line) {
  return waitFor([&line](const std::string& heard) { return heard == line; }).has_value();
}

}  // namespace bleedsim::service_test
