#include "service/transport/clock.h"

#include <ctime>

namespace bleedsim::transport {
namespace {

std::int64_t now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

std::int64_t monotonicNow() { return now(CLOCK_MONOTONIC); }
std::int64_t realtimeNow() { return now(CLOCK_REALTIME); }

}  // namespace bleedsim::transport
