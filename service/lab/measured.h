// A figure and how far it can be trusted.
#pragma once

#include <span>
#include <vector>

namespace bleedsim::lab {

/// A figure with the scatter of its samples.
struct Measured {
  double value = 0.0;
  double scatter = 0.0;
};

/// Median with the median absolute deviation from it, which one disturbed sample does not move. Zero of nothing.
Measured medianOf(std::vector<double> values);
/// Mean with its standard error; 0 of a single sample, zero of nothing.
Measured meanOf(std::span<const double> values);

}  // namespace bleedsim::lab
