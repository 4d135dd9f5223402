// The ranges that a scene's values must be in. They bound memory and time, keep float32 meaningful and exclude unit mistakes;
// inside them a scene may still be unwise.
#pragma once

#include <cstdint>
#include <string_view>

#include "service/sph/frame_rate.h"

namespace bleedsim::scene {

/// Both ends are allowed.
struct Range {
  double lower;
  double upper;
  std::string_view unit;  ///< empty: a pure number
};

inline constexpr Range kCoordinate{-10.0, 10.0, "m"};
inline constexpr double kMaxDomainSide = 10.0;     ///< m
inline constexpr double kMinPeriodicSide = 3.0;    ///< support radii
inline constexpr double kMaxCells = 16'777'216.0;  ///< grid cells of one support radius
inline constexpr Range kCapacity{1.0, 2'000'000.0, "particles"};
inline constexpr Range kSpacing{1e-5, 0.02, "m"};
inline constexpr Range kSupportRatio{1.5, 3.5, ""};
inline constexpr Range kDensity{500.0, 5000.0, "kg/m^3"};
inline constexpr Range kMachFactor{5.0, 50.0, ""};
inline constexpr Range kDesignSpeed{0.001, 20.0, "m/s"};
inline constexpr Range kMaxFallOrDepth{0.0, 10.0, "m"};
inline constexpr Range kMaxDt{1e-9, 1.0, "s"};

inline constexpr Range kGravity{0.0, 1000.0, "m/s^2, its length"};
inline constexpr Range kBackgroundPressure{0.0, 1e6, "Pa"};
inline constexpr Range kViscosity{0.0, 1000.0, "Pa s"};
inline constexpr Range kMaxSources{1.0, 256.0, "sources"};

inline constexpr Range kDirection{1e-6, 1e6, ""};
inline constexpr Range kSlip{0.0, 1.0, ""};
inline constexpr Range kBowlRadius{1e-4, 10.0, "m"};

inline constexpr Range kPatchLength{1e-5, 0.1, "m"};
inline constexpr Range kPatchCoordinate{-0.1, 0.1, "m"};
inline constexpr double kMinPatchArea = 1e-10;  ///< m^2
inline constexpr int kMinPolygonPoints = 3;
inline constexpr int kMinPolylinePoints = 2;
inline constexpr int kMaxPatchPoints = 256;
inline constexpr Range kFlow{0.0, 1000.0, "mL/s"};
inline constexpr Range kInletPressure{0.0, 1000.0, "mmHg"};
inline constexpr Range kDischargeCoefficient{0.1, 1.0, ""};

inline constexpr Range kBlockSpeed{0.0, 100.0, "m/s, its length"};
inline constexpr Range kJitter{0.0, 0.2, "spacings"};

inline constexpr Range kFrameRate{sph::kMinFrameRate, sph::kMaxFrameRate, "frames per simulated s"};
inline constexpr Range kInstrumentExpiry{0.01, 10.0, "s"};
inline constexpr Range kMaxWounds{1.0, 1023.0, "wounds"};

inline constexpr int kMaxTissues = 16;
inline constexpr int kMaxSceneWounds = 64;
inline constexpr int kMaxFluidBlocks = 64;
inline constexpr int kMaxAttributes = 16;
inline constexpr int kMaxNameBytes = 64;
inline constexpr int kMaxDescriptionBytes = 4096;

}  // namespace bleedsim::scene
