#include "service/lab/measured.h"

#include <algorithm>
#include <cmath>

namespace bleedsim::lab {
namespace {

double middleOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

Measured medianOf(std::vector<double> values) {
  if (values.empty()) return {};
  const double median = middleOf(values);
  for (double& value : values) value = std::abs(value - median);
  return {median, middleOf(values)};
}

Measured meanOf(std::span<const double> values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / (count * (count - 1.0))) : 0.0};
}

}  // namespace bleedsim::lab
