#include "clients/bleedctl/stop_signal.h"

#include <csignal>
#include <ctime>

namespace bleedsim::bleedctl {
namespace {

sigset_t stopSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

void blockStopSignals() {
  const sigset_t set = stopSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

bool waitForStopSignal(std::chrono::milliseconds timeout) {
  const sigset_t set = stopSignals();
  const timespec time{.tv_sec = timeout.count() / 1000, .tv_nsec = (timeout.count() % 1000) * 1'000'000};
  return sigtimedwait(&set, nullptr, &time) > 0;
}

}  // namespace bleedsim::bleedctl
