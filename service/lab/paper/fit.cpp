#include "service/lab/paper/fit.h"

#include <cmath>
#include <vector>

namespace bleedsim::lab {
namespace {

double meanOf(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double squaredResiduals(const LineFit& fit, std::span<const double> x, std::span<const double> y) {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = y[k] - fit.intercept - fit.slope * x[k];
    sum += residual * residual;
  }
  return sum;
}

}  // namespace

LineFit fitLine(std::span<const double> x, std::span<const double> y) {
  const double mean_x = meanOf(x);
  const double mean_y = meanOf(y);
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
    yy += (y[k] - mean_y) * (y[k] - mean_y);
  }
  if (!(xx > 0.0)) return {};
  LineFit fit;
  fit.slope = xy / xx;
  fit.intercept = mean_y - fit.slope * mean_x;
  const double residuals = squaredResiduals(fit, x, y);
  fit.r2 = yy > 0.0 ? 1.0 - residuals / yy : 1.0;
  if (x.size() > 2) fit.slope_error = std::sqrt(residuals / (static_cast<double>(x.size() - 2) * xx));
  return fit;
}

PowerFit fitPower(std::span<const double> x, std::span<const double> y) {
  std::vector<double> log_x;
  std::vector<double> log_y;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] > 0.0) || !(y[k] > 0.0)) return {};
    log_x.push_back(std::log(x[k]));
    log_y.push_back(std::log(y[k]));
  }
  const LineFit line = fitLine(log_x, log_y);
  if (line.r2 == 0.0 && line.slope == 0.0 && line.intercept == 0.0) return {};
  return {.exponent = line.slope, .factor = std::exp(line.intercept), .r2 = line.r2, .exponent_error = line.slope_error};
}

double scatterAboutTrend(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 3) return 0.0;
  return std::sqrt(squaredResiduals(fitLine(x, y), x, y) / static_cast<double>(x.size() - 2));
}

}  // namespace bleedsim::lab
