// Ranges of requests that the service checks and the clients tell of before they send.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bleedsim {

inline constexpr std::uint32_t kMaxStepCount = 10'000'000;
inline constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20;
/// Simulated s per s.
inline constexpr double kMinPace = 1e-4;
inline constexpr double kMaxPace = 1e3;
/// Wall s of one acquisition.
inline constexpr double kMinLease = 1.0;
inline constexpr double kMaxLease = 300.0;

}  // namespace bleedsim
