// The ranges that values from outside must be in. They exclude nonsense and unit mistakes before anything is computed from them;
// the world checks what depends on the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "service/sph/frame_rate.h"
#include "service/status/request_limits.h"

namespace bleedsim::dds {

/// Both ends are allowed.
struct Limits {
  double lower;
  double upper;
  std::string_view unit;
};

inline constexpr Limits kPositionLimits{-1e6, 1e6, "m"};
inline constexpr Limits kDirectionLengthLimits{1e-6, 1e6, ""};
inline constexpr Limits kLengthLimits{1e-6, 1e3, "m"};
inline constexpr Limits kOutlineLimits{-1e3, 1e3, "m"};
inline constexpr Limits kFlowLimits{0.0, 1e6, "mL/s"};
inline constexpr Limits kPressureLimits{0.0, 1e6, "mmHg"};
inline constexpr Limits kDischargeLimits{0.0, 1.0, "(0 takes the default)"};
inline constexpr Limits kForceLimits{-1e6, 1e6, "N"};
inline constexpr Limits kDurationLimits{1e-9, 1e6, "simulated s"};
inline constexpr Limits kPaceLimits{kMinPace, kMaxPace, "simulated s per s"};
inline constexpr Limits kFrameRateLimits{sph::kMinFrameRate, sph::kMaxFrameRate, "frames per simulated s; 0 keeps the rate"};
inline constexpr double kDefaultDischargeCoefficient = 0.61;

inline constexpr std::uint32_t kMinPolygonPoints = 3;
inline constexpr std::uint32_t kMinPolylinePoints = 2;
inline constexpr std::uint32_t kMaxOutlinePoints = 256;
using bleedsim::kMaxSceneBytes;
using bleedsim::kMaxStepCount;
inline constexpr std::size_t kMaxReasonBytes = 127;

}  // namespace bleedsim::dds
