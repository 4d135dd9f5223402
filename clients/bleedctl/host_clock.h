// The clock of this host: whether the kernel keeps it synchronised, and how far others are from it.
#pragma once

#include <cstdint>
#include <optional>

#include "bleedsim/commands.h"
#include "bleedsim/types.h"

namespace bleedsim::bleedctl {

struct ClockState {
  bool synchronised = false;
  double max_error_s = 0.0;  ///< as the kernel estimates it
};

/// Of adjtimex(2); nothing where the kernel does not tell.
std::optional<ClockState> readClockState();

struct ClockDifference {
  double ahead_s = 0.0;        ///< the daemon's clock of the day minus ours
  double uncertainty_s = 0.0;  ///< half a round trip
};

/// From both clocks of the daemon in its status, both of ours read at one moment, and the offset of its monotonic clock to ours.
ClockDifference clockDifference(const client::SessionStatus& status, const client::ClockOffset& offset,
                                std::int64_t own_monotonic_ns, std::int64_t own_realtime_ns);

}  // namespace bleedsim::bleedctl
