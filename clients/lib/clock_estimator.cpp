#include "clients/lib/clock_estimator.h"

#include <algorithm>

namespace bleedsim::client {
namespace {

// Stamps come from outside: larger ones could overflow the differences below.
constexpr std::int64_t kLargestStamp = std::int64_t{1} << 61;

bool inRange(std::int64_t stamp) { return stamp >= 0 && stamp < kLargestStamp; }

}  // namespace

bool ClockEstimator::add(std::int64_t t0, std::int64_t t1, std::int64_t t2, std::int64_t t3) {
  if (!inRange(t0) || !inRange(t1) || !inRange(t2) || !inRange(t3)) return false;
  if (t3 < t0 || t2 < t1 || t3 - t0 < t2 - t1) return false;
  samples_[next_] = {.offset_ns = ((t1 - t0) + (t2 - t3)) / 2, .round_trip_ns = (t3 - t0) - (t2 - t1)};
  next_ = (next_ + 1) % kWindow;
  count_ = std::min(count_ + 1, kWindow);
  return true;
}

std::optional<ClockOffset> ClockEstimator::best() const {
  if (count_ == 0) return std::nullopt;
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(count_);
  ClockOffset out = *std::min_element(
      samples_.begin(), end, [](const ClockOffset& a, const ClockOffset& b) { return a.round_trip_ns < b.round_trip_ns; });
  out.samples = static_cast<std::uint32_t>(count_);
  return out;
}

}  // namespace bleedsim::client
