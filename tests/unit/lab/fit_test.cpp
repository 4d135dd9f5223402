// Fits of points whose law is known.
#include "service/lab/paper/fit.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::lab {
namespace {

TEST(FitLine, FindsALine) {
  const std::vector<double> x{0.0, 1.0, 2.0, 5.0};
  const std::vector<double> y{3.0, 1.0, -1.0, -7.0};
  const LineFit fit = fitLine(x, y);
  EXPECT_NEAR(fit.slope, -2.0, 1e-12);
  EXPECT_NEAR(fit.intercept, 3.0, 1e-12);
  EXPECT_NEAR(fit.r2, 1.0, 1e-12);
}

// y = x with +1 and -1 on points that know nothing of x: residuals 1 each, variance of x 1.25 beside it.
TEST(FitLine, SaysHowMuchItExplains) {
  const std::vector<double> x{-1.5, -0.5, 0.5, 1.5};
  const std::vector<double> y{-1.5 + 1.0, -0.5 - 1.0, 0.5 - 1.0, 1.5 + 1.0};
  const LineFit fit = fitLine(x, y);
  EXPECT_NEAR(fit.slope, 1.0, 1e-12);
  EXPECT_NEAR(fit.r2, 1.25 / 2.25, 1e-12);
}

// The same points: the residuals' squares sum to 4 over two degrees of freedom, x's to 5. sqrt(4/2/5).
TEST(FitLine, SaysHowSureItsSlopeIs) {
  const std::vector<double> x{-1.5, -0.5, 0.5, 1.5};
  const std::vector<double> y{-1.5 + 1.0, -0.5 - 1.0, 0.5 - 1.0, 1.5 + 1.0};
  const LineFit fit = fitLine(x, y);
  ASSERT_TRUE(fit.slope_error.has_value());
  EXPECT_NEAR(*fit.slope_error, std::sqrt(0.4), 1e-12);
  EXPECT_FALSE(fitLine(std::span{x}.first(2), std::span{y}.first(2)).slope_error.has_value()) << "no residual is left";
}

TEST(FitLine, OfOnePlaceIsNothing) {
  const std::vector<double> x{2.0, 2.0};
  const std::vector<double> y{1.0, 3.0};
  EXPECT_EQ(fitLine(x, y).r2, 0.0);
  EXPECT_EQ(fitLine({}, {}).slope, 0.0);
}

TEST(FitPower, FindsTheExponentOfAnInverseSquare) {
  std::vector<double> x;
  std::vector<double> y;
  for (const double n : {12000.0, 15000.0, 18000.0, 22000.0}) {
    x.push_back(n);
    y.push_back(7e8 / (n * n));
  }
  const PowerFit fit = fitPower(x, y);
  EXPECT_NEAR(fit.exponent, -2.0, 1e-9);
  EXPECT_NEAR(fit.factor, 7e8, 7e8 * 1e-7);
  EXPECT_NEAR(fit.r2, 1.0, 1e-12);
}

TEST(FitPower, NeedsNumbersAboveZero) {
  const std::vector<double> x{1.0, 2.0};
  const std::vector<double> y{1.0, 0.0};
  EXPECT_EQ(fitPower(x, y).exponent, 0.0);
}

TEST(ScatterAboutTrend, LeavesTheTrendOut) {
  const std::vector<double> x{1.0, 2.0, 3.0, 4.0};
  const std::vector<double> line{10.0, 20.0, 30.0, 40.0};
  EXPECT_NEAR(scatterAboutTrend(x, line), 0.0, 1e-12);
  const std::vector<double> about{11.0, 19.0, 29.0, 41.0};  // residuals +-1, two degrees of freedom: sqrt(4/2)
  EXPECT_NEAR(scatterAboutTrend(x, about), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(scatterAboutTrend({}, {}), 0.0);
}

}  // namespace
}  // namespace bleedsim::lab
