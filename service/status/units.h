// The units of scenes and of the wire against the SI units of the solver.
#pragma once

namespace bleedsim {

inline constexpr double kCubicMetresPerMl = 1e-6;
/// Conventional millimetre of mercury.
inline constexpr double kPascalsPerMmHg = 133.322387415;

constexpr double mlFromCubicMetres(double cubic_metres) { return cubic_metres / kCubicMetresPerMl; }
constexpr double cubicMetresFromMl(double ml) { return ml * kCubicMetresPerMl; }
constexpr double pascalsFromMmHg(double mmhg) { return mmhg * kPascalsPerMmHg; }
constexpr double mmHgFromPascals(double pascals) { return pascals / kPascalsPerMmHg; }

}  // namespace bleedsim
