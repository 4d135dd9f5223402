#include "service/lab/dice.h"

#include <cmath>

namespace bleedsim::lab {

std::uint64_t Dice::bits() {
  // SplitMix64, Steele, Lea & Flood 2014.
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

double Dice::overMagnitudes(double lowest, double highest) { return std::exp(between(std::log(lowest), std::log(highest))); }

sph::Vec3 Dice::within(const sph::Vec3& lower, const sph::Vec3& upper) {
  const double x = between(lower.x(), upper.x());
  const double y = between(lower.y(), upper.y());
  return {x, y, between(lower.z(), upper.z())};
}

}  // namespace bleedsim::lab
