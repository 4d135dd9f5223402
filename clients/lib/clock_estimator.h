// Offset between two monotonic clocks, after NTP (RFC 5905, section 8): with a request sent at t0, received at t1, answered at t2
// and back at t3, offset = ((t1 - t0) + (t2 - t3)) / 2 and round trip = (t3 - t0) - (t2 - t1). Queueing only ever lengthens a
// round trip, so the sample with the shortest one among the last kWindow is the best.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "bleedsim/commands.h"

namespace bleedsim::client {

class ClockEstimator {
 public:
  static constexpr std::size_t kWindow = 64;

  /// False, and ignored: stamps that run backwards.
  bool add(std::int64_t t0, std::int64_t t1, std::int64_t t2, std::int64_t t3);
  std::optional<ClockOffset> best() const;

 private:
  std::array<ClockOffset, kWindow> samples_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace bleedsim::client
