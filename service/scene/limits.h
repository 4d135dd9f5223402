// The ranges that a scene's values must be in, beside those that it shares with requests. They bound memory and time, keep
// float32 meaningful and exclude unit mistakes; inside them a scene may still be unwise.
#pragma once

#include "service/sph/frame_rate.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::scene {

inline constexpr double kMaxDomainSide = 10.0;   ///< m
inline constexpr double kMinPeriodicSide = 3.0;  ///< support radii
inline constexpr Range kCapacity{1.0, 2'000'000.0, "particles"};
inline constexpr Range kSpacing{1e-5, 0.02, "m"};
inline constexpr Range kSupportRatio{1.5, 3.5, ""};
inline constexpr Range kDensity{500.0, 5000.0, "kg/m^3"};
inline constexpr Range kMachFactor{5.0, 50.0, ""};
inline constexpr Range kDesignSpeed{0.001, 20.0, "m/s"};
inline constexpr Range kMaxFallOrDepth{0.0, 10.0, "m"};
inline constexpr Range kMaxDt{1e-9, 1.0, "s"};
inline constexpr Range kHorizon{1e-3, 1e6, "s"};

inline constexpr Range kGravity{0.0, 1000.0, "m/s^2, its length"};
inline constexpr Range kBackgroundPressure{0.0, 1e6, "Pa"};
inline constexpr Range kViscosity{0.0, 1000.0, "Pa s"};
inline constexpr Range kShearViscosity{1e-5, 1000.0, "Pa s"};  ///< of a rheology: it is divided by
inline constexpr Range kRheologyTime{1e-6, 1e4, "s"};
inline constexpr Range kRheologyPower{0.05, 1.0, "1"};
inline constexpr Range kRheologyTransition{0.1, 10.0, "1"};
inline constexpr Range kYieldStress{0.0, 100.0, "Pa"};
inline constexpr Range kRegularisation{1e-3, 100.0, "1/s"};
inline constexpr Range kSolveTolerance{1e-6, 0.5, "1"};
inline constexpr Range kSolveIterations{1.0, 1000.0, "iterations"};
inline constexpr Range kSurfaceTension{1e-5, 1.0, "N/m"};
inline constexpr Range kTemperature{0.0, 60.0, "degrees C"};
inline constexpr Range kNormalCutoff{0.01, 3.0, "1"};
inline constexpr Range kContactAngle{0.0, 180.0, "degrees"};
inline constexpr Range kPlatelet{0.0, 1.0, "1"};
inline constexpr Range kDiffusivity{0.0, 1e-3, "m^2/s"};
inline constexpr Range kClotRate{0.0, 100.0, "1/s"};
inline constexpr Range kShearGate{0.1, 1e6, "1/s"};
inline constexpr Range kClotSpeedup{0.0, 1e4, "1"};
inline constexpr Range kSmallestRadius{0.5, 1.0, "1"};
inline constexpr Range kLargestRadius{1.0, 1.5, "1"};
inline constexpr Range kRadiusRelaxation{1e-3, 1.0, "1"};
inline constexpr Range kRepulsionStrength{0.0, 10.0, "1"};
inline constexpr Range kContactDistance{0.1, 1.0, "spacings"};
inline constexpr Range kRepulsionPower{1.0, 12.0, "1"};
inline constexpr Range kRepulsionDamping{0.0, 10.0, "c0/dx"};
inline constexpr Range kAdhesion{0.0, 1000.0, "m/s^2"};
inline constexpr Range kLiteralStiffness{1e-6, 1e6, "m^2/s^2"};
inline constexpr Range kLiteralTension{0.0, 1.0, "N/m"};
inline constexpr Range kLiteralExponent{0.0, 50.0, "1"};
inline constexpr Range kLiteralRepulsion{0.0, 1e6, "N m^2"};
inline constexpr Range kLiteralContact{0.05, 0.5, "spacings"};
inline constexpr Range kMaxSources{1.0, 256.0, "sources"};

inline constexpr Range kSlip{0.0, 1.0, ""};
inline constexpr Range kBowlRadius{1e-4, 10.0, "m"};

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
