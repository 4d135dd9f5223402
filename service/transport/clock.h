// The two clocks of the wire's stamps.
#pragma once

#include <cstdint>

namespace bleedsim::transport {

/// Nanoseconds of CLOCK_MONOTONIC: shared by all processes of one host.
std::int64_t monotonicNow();
/// Nanoseconds since 1970 of CLOCK_REALTIME.
std::int64_t realtimeNow();

}  // namespace bleedsim::transport
