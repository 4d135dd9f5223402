// The ranges of requests, beside those that they share with scenes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "service/sph/frame_rate.h"
#include "service/status/quantity_limits.h"
#include "service/status/request_limits.h"

namespace bleedsim::dds {

/// Components of directions and quaternions: what matters is checked of the whole.
inline constexpr Range kComponent{-kDirection.upper, kDirection.upper, ""};
inline constexpr Range kDischargeOrDefault{kDischargeCoefficient.lower, kDischargeCoefficient.upper, "or 0 for the default"};
inline constexpr Range kPaceRange{kMinPace, kMaxPace, "simulated s per s"};
inline constexpr Range kFrameRateRange{sph::kMinFrameRate, sph::kMaxFrameRate, "frames per simulated s; 0 keeps the rate"};
inline constexpr Range kLeaseRange{kMinLease, kMaxLease, "s of wall time"};
inline constexpr double kDefaultDischargeCoefficient = 0.61;

using bleedsim::kMaxSceneBytes;
using bleedsim::kMaxStepCount;
inline constexpr std::size_t kMaxReasonBytes = 127;

}  // namespace bleedsim::dds
