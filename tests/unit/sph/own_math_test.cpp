// exp, log and pow against those of the C library in long double.
#include "service/sph/own_math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::sph {
namespace {

template <class Real>
double relativeError(Real found, long double exact) {
  return static_cast<double>(std::abs((static_cast<long double>(found) - exact) / exact));
}

// The errors that own_math.h states; half a unit in the last place of float is 2^-24 = 5.96e-8.
TEST(OwnMath, ExpIsWithinItsError) {
  double worst = 0.0;
  double worst_float = 0.0;
  for (int k = -70'000; k <= 70'000; ++k) {
    const double x = 0.0100123 * k;
    worst = std::max(worst, relativeError(ownExp(x), std::exp(static_cast<long double>(x))));
    const auto y = static_cast<float>(0.00124 * k);
    worst_float = std::max(worst_float, relativeError(ownExp(y), std::exp(static_cast<long double>(y))));
  }
  EXPECT_LT(worst, 3e-16);
  EXPECT_LT(worst_float, 6.1e-8);
  EXPECT_EQ(ownExp(0.0), 1.0);
  EXPECT_TRUE(std::isfinite(ownExp(1e300)));
  EXPECT_GT(ownExp(-1e300), 0.0);
  EXPECT_TRUE(std::isnan(ownExp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(OwnMath, LogIsWithinItsError) {
  double worst = 0.0;
  double worst_float = 0.0;
  for (int k = -70'000; k <= 70'000; ++k) {
    for (const double x : {std::exp(0.0100123 * k), 1.0 + 1e-6 * (k + 0.5)}) {
      worst = std::max(worst, relativeError(ownLog(x), std::log(static_cast<long double>(x))));
    }
    const auto y = static_cast<float>(std::exp(0.00124 * (k + 0.5)));
    if (y != 1.0f) worst_float = std::max(worst_float, relativeError(ownLog(y), std::log(static_cast<long double>(y))));
  }
  EXPECT_LT(worst, 4e-16);
  EXPECT_LT(worst_float, 6.1e-8);
  EXPECT_EQ(ownLog(1.0), 0.0);
}

// A relative error of eps in the logarithm is |e ln b| eps in the power.
TEST(OwnMath, PowIsWithinItsError) {
  double worst = 0.0;
  double worst_float = 0.0;
  for (int k = -200; k <= 200; ++k) {
    const double base = std::exp(0.0503 * k);
    for (const double exponent : {-12.5, -1.0, -0.3216, 0.3568, 0.5, 2.0, 7.3}) {
      const double allowed = 1.0 + std::abs(exponent * 0.0503 * k);
      worst = std::max(worst, relativeError(ownPow(base, exponent),
                                            std::pow(static_cast<long double>(base), static_cast<long double>(exponent))) /
                                  allowed);
      const auto b = static_cast<float>(base);
      const auto e = static_cast<float>(exponent);
      const long double exact = std::pow(static_cast<long double>(b), static_cast<long double>(e));
      if (exact > 1e-37L && exact < 1e38L) worst_float = std::max(worst_float, relativeError(ownPow(b, e), exact));
    }
  }
  EXPECT_LT(worst, 6e-16);
  EXPECT_LT(worst_float, 6.1e-8);
  EXPECT_EQ(ownPow(0.0, 2.0), 0.0);
  EXPECT_EQ(ownPow(0.0f, 0.3f), 0.0f);
}

// What a recording relies on: these bits, on any machine. Fused multiply-adds or another evaluation order would change them.
TEST(OwnMath, BitsAreFixed) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  EXPECT_EQ(bits(ownExp(1.0)), 0x4005bf0a8b14576aull);
  EXPECT_EQ(bits(ownLog(10.0)), 0x40026bb1bbb55516ull);
}

}  // namespace
}  // namespace bleedsim::sph
