#include "service/daemon/signals.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace bleedsim::daemon {

Result<std::unique_ptr<SignalWatch>> SignalWatch::create() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  const int signals = pthread_sigmask(SIG_BLOCK, &set, nullptr) == 0 ? signalfd(-1, &set, SFD_CLOEXEC) : -1;
  const int end = eventfd(0, EFD_CLOEXEC);
  if (signals >= 0 && end >= 0) return std::unique_ptr<SignalWatch>{new SignalWatch{signals, end}};
  const std::string reason = std::strerror(errno);
  if (signals >= 0) close(signals);
  if (end >= 0) close(end);
  return Status{StatusCode::io, "could not watch for signals: " + reason};
}

SignalWatch::~SignalWatch() {
  stop();
  close(signals_);
  close(end_);
}

void SignalWatch::start(Calls calls) {
  calls_ = std::move(calls);
  thread_ = std::thread{[this] { watch(); }};
}

void SignalWatch::stop() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  static_cast<void>(!write(end_, &one, sizeof one));
  thread_.join();
}

void SignalWatch::watch() const {
  bool first = true;
  std::array<pollfd, 2> waited{{{signals_, POLLIN, 0}, {end_, POLLIN, 0}}};
  for (;;) {
    if (poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR) return;
    if ((waited[1].revents & POLLIN) != 0) return;
    signalfd_siginfo info{};
    if ((waited[0].revents & POLLIN) == 0 || read(signals_, &info, sizeof info) != sizeof info) continue;
    if (info.ssi_signo == SIGHUP && calls_.hangup) {
      calls_.hangup();
      continue;
    }
    if (!first) std::_Exit(EXIT_FAILURE);
    first = false;
    calls_.end();
  }
}

}  // namespace bleedsim::daemon
