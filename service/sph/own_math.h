// exp, log and pow with the same bits on every machine: the C library's own change between machines.
//
// Only +, -, *, / and bit casts, in double precision also for float, so a float result is the rounded one of double:
//   exp   within 3e-16 relative: 2^k e^r, |r| <= ln(2)/2, Taylor to r^13
//   log   within 4e-16 relative: k ln 2 + 2 atanh((m-1)/(m+1)), m in [sqrt(1/2), sqrt(2)), series to the 21st power
//   pow   within (1 + |e ln b|) 6e-16 relative
// For float all three are within 6.1e-8 relative, half a unit in the last place, wherever the result is a normal float.
#pragma once

#include <bit>
#include <cstdint>

namespace bleedsim::sph {
namespace own_math {

constexpr double kLn2High = 0x1.62e42feep-1;  // 32 bits, so that its products with exponents are exact
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kInverseLn2 = 1.4426950408889634;
constexpr double kLargestArgument = 709.0;  // of exp: no overflow, no denormal result

}  // namespace own_math

/// e^x; x is taken as within +-709. NaN stays NaN.
inline double ownExp(double x) {
  using namespace own_math;
  if (x > kLargestArgument) x = kLargestArgument;
  if (x < -kLargestArgument + 1.0) x = -kLargestArgument + 1.0;
  constexpr double kToInteger = 0x1.8p52;  // adding it rounds to the nearest integer, which then stands in the lowest bits
  const double shifted = x * kInverseLn2 + kToInteger;
  const double k = shifted - kToInteger;
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double sum = 1.0 / 6227020800.0;
  sum = sum * r + 1.0 / 479001600.0;
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  sum = sum * (r * r) + r + 1.0;
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52;
  return sum * std::bit_cast<double>(exponent);
}

/// ln x of a positive normal number.
inline double ownLog(double x) {
  using namespace own_math;
  // The exponent counts from sqrt(1/2), so that m is near 1 where x is.
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcdull;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t offset = bits - kRootHalf;
  const double k = static_cast<double>(static_cast<std::int64_t>(offset) >> 52);
  const double m = std::bit_cast<double>(bits - (offset & 0xfff0000000000000ull));
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double sum = 2.0 / 21.0;
  sum = sum * s2 + 2.0 / 19.0;
  sum = sum * s2 + 2.0 / 17.0;
  sum = sum * s2 + 2.0 / 15.0;
  sum = sum * s2 + 2.0 / 13.0;
  sum = sum * s2 + 2.0 / 11.0;
  sum = sum * s2 + 2.0 / 9.0;
  sum = sum * s2 + 2.0 / 7.0;
  sum = sum * s2 + 2.0 / 5.0;
  sum = sum * s2 + 2.0 / 3.0;
  return k * kLn2High + (k * kLn2Low + (sum * s2 * s + 2.0 * s));
}

/// base^exponent of a base >= 0; 0 to any power is 0.
inline double ownPow(double base, double exponent) {
  constexpr double kSmallestNormal = 0x1p-1022;
  return base < kSmallestNormal ? 0.0 : ownExp(exponent * ownLog(base));
}

inline float ownExp(float x) { return static_cast<float>(ownExp(static_cast<double>(x))); }
inline float ownLog(float x) { return static_cast<float>(ownLog(static_cast<double>(x))); }
inline float ownPow(float base, float exponent) {
  return static_cast<float>(ownPow(static_cast<double>(base), static_cast<double>(exponent)));
}

}  // namespace bleedsim::sph
