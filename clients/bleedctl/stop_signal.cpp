#include "clients/bleedctl/stop_signal.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "clients/bleedctl/exit_codes.h"

namespace bleedsim::bleedctl {
namespace {

// The handler runs on any thread, the middleware's included, and may use nothing but these and system calls.
std::atomic<bool> held = false;
std::atomic<int> stopped = -1;  // an eventfd that stays readable once a signal was noted
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void onStopSignal(int /*signal*/) {
  if (!held) _exit(kInterrupted);
  const int before = errno;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(stopped, &one, sizeof one);
  errno = before;
}

}  // namespace

void endOnStopSignals() {
  held = false;
  struct sigaction action {};
  action.sa_handler = onStopSignal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void holdStopSignals() {
  if (stopped < 0) stopped = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  held = stopped >= 0;
}

bool waitForStopSignal(std::chrono::milliseconds timeout) {
  pollfd waited{stopped, POLLIN, 0};
  // Interrupted by the signal itself: it is readable now.
  int ready = 0;
  do { ready = poll(&waited, 1, static_cast<int>(timeout.count())); } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace bleedsim::bleedctl
