// Least squares: how one figure follows another.
#pragma once

#include <optional>
#include <span>

namespace bleedsim::lab {

struct LineFit {
  double slope = 0.0;
  double intercept = 0.0;
  double r2 = 0.0;                    ///< share of the variance that the line explains; 1 where y does not vary
  std::optional<double> slope_error;  ///< standard error; none with fewer than three points, which leave no residual
};
/// y = intercept + slope x. All zero unless there are two different x. Both spans are equally long.
LineFit fitLine(std::span<const double> x, std::span<const double> y);

struct PowerFit {
  double exponent = 0.0;
  double factor = 0.0;
  double r2 = 0.0;                       ///< of the logarithms
  std::optional<double> exponent_error;  ///< standard error; none with fewer than three points
};
/// y = factor x^exponent, by a line through the logarithms. All zero unless every x and y is above 0 and two x differ.
PowerFit fitPower(std::span<const double> x, std::span<const double> y);

/// Standard deviation about the fitted line, with n - 2 degrees of freedom: the scatter of a figure beside its trend. 0 with
/// fewer than three points.
double scatterAboutTrend(std::span<const double> x, std::span<const double> y);

}  // namespace bleedsim::lab
