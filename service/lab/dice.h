// Random numbers that are the same on every machine, which those of the standard library's distributions are not.
#pragma once

#include <cstdint>

#include "service/sph/effect_settings.h"

namespace bleedsim::lab {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_{seed} {}

  std::uint64_t bits();
  double part() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< 0 to 1
  double between(double lowest, double highest) { return lowest + (highest - lowest) * part(); }
  /// Spread evenly over the orders of magnitude, on this machine's libm.
  double overMagnitudes(double lowest, double highest);
  int upTo(int most) { return static_cast<int>(bits() % (static_cast<std::uint64_t>(most) + 1)); }
  bool chance(double likely) { return part() < likely; }
  sph::Vec3 within(const sph::Vec3& lower, const sph::Vec3& upper);

 private:
  std::uint64_t state_;
};

}  // namespace bleedsim::lab
