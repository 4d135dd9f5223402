// The ranges of the physical quantities that scenes and requests share: one definition for both, and for clients that tell of
// them before they send. They exclude nonsense and unit mistakes; what depends on the scene is the world's to check.
#pragma once

#include <cstddef>
#include <string_view>

namespace bleedsim {

/// Both ends are allowed.
struct Range {
  double lower;
  double upper;
  std::string_view unit;  ///< empty: a pure number
};

inline constexpr Range kCoordinate{-10.0, 10.0, "m"};
inline constexpr Range kDirection{1e-6, 1e6, ""};  ///< length of a vector that is normalised

inline constexpr Range kPatchLength{1e-5, 0.1, "m"};  ///< of a wound's radius, semi-axis or width
inline constexpr Range kPatchCoordinate{-0.1, 0.1, "m"};
inline constexpr double kMinPatchArea = 1e-10;  ///< m^2
inline constexpr std::size_t kMinPolygonPoints = 3;
inline constexpr std::size_t kMinPolylinePoints = 2;
inline constexpr std::size_t kMaxPatchPoints = 256;
inline constexpr Range kFlow{0.0, 1000.0, "mL/s"};
inline constexpr Range kInletPressure{0.0, 1000.0, "mmHg"};
inline constexpr Range kDischargeCoefficient{0.1, 1.0, ""};

inline constexpr Range kForce{0.0, 1e6, "N, its length"};
inline constexpr Range kForceRadius{1e-5, 10.0, "m"};  ///< of a force's or an instrument's reach
inline constexpr Range kForceDuration{1e-9, 1e6, "simulated s"};

}  // namespace bleedsim
