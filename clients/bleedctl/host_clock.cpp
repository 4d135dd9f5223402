#include "clients/bleedctl/host_clock.h"

#include <sys/timex.h>

namespace bleedsim::bleedctl {

std::optional<ClockState> readClockState() {
  timex time{};
  const int state = adjtimex(&time);
  if (state < 0) return {};
  const bool synchronised = state != TIME_ERROR && (time.status & STA_UNSYNC) == 0;
  return ClockState{synchronised, static_cast<double>(time.maxerror) * 1e-6};
}

// day - monotonic tells when a host started, by its clock of the day. Both clocks of a host are read at the same moment, so the
// time on the way does not matter here; it does in the offset.
ClockDifference clockDifference(const client::SessionStatus& status, const client::ClockOffset& offset,
                                std::int64_t own_monotonic_ns, std::int64_t own_realtime_ns) {
  const std::int64_t theirs = status.realtime_stamp_ns - status.monotonic_stamp_ns;
  const std::int64_t ours = own_realtime_ns - own_monotonic_ns;
  const std::int64_t ahead = theirs - ours + offset.offset_ns;
  return {static_cast<double>(ahead) * 1e-9, static_cast<double>(offset.round_trip_ns) * 0.5e-9};
}

}  // namespace bleedsim::bleedctl
