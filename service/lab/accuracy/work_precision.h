// Error against time: what was measured of each setting, and what follows from it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/lab/accuracy/settings.h"
#include "service/lab/effect_costs.h"
#include "service/lab/machine.h"

namespace bleedsim::lab {

/// Median with the smallest and the largest of the runs.
struct Spread {
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};
/// Zero of nothing.
Spread spreadOf(std::vector<double> values);

struct Measurement {
  Setting setting;
  std::vector<Figure> figures;  ///< the case's error figures, in its order; at least one
  std::uint32_t particles = 0;
  std::uint64_t steps = 0;  ///< of one run
  int runs = 0;
  Spread cpu;           ///< s for each simulated s
  Spread wall;          ///< s for each simulated s
  Spread microseconds;  ///< CPU time per particle and step
  double realTimeFactor() const { return wall.median > 0.0 ? 1.0 / wall.median : 0.0; }
  /// Null if there is none of that name.
  const Figure* find(std::string_view figure) const;
};

/// What was not measured, and why.
struct LeftOut {
  Setting setting;
  std::string reason;
  std::optional<double> needs;  ///< s that a run is expected to take, where time was short
};

struct AccuracyResults {
  Machine machine;
  double minutes = 0.0;  ///< that were allowed
  double took = 0.0;     ///< s
  std::vector<Measurement> measurements;
  std::vector<LeftOut> left_out;
  std::optional<EffectCosts> effects;
};

struct AccuracyOptions {
  std::vector<const ValidationCase*> cases;
  std::vector<std::string> knobs;
  double minutes = 6.0;
  int runs = 3;
  bool effects = true;
};

/// Everything once, round by round and in each the cheapest first, then again. Keeps the time: what is expected not to fit is
/// left out, with the reason.
AccuracyResults measureAccuracy(const AccuracyOptions& options, const std::function<void(double)>& progress);

/// Indices of the measurements that no other one of the same list beats in both time and error, by time.
std::vector<std::size_t> paretoFront(const std::vector<double>& time, const std::vector<double>& error);

/// p of error ~ x^-p by least squares of the logarithms; none with fewer than two points above 0.
std::optional<double> convergenceOrder(const std::vector<double>& x, const std::vector<double>& error);

/// What part of a figure of a case each knob is responsible for: the change of its value, over the reference, from the base
/// to the finest spacing, the shortest step and the largest Mach factor that were measured; none without one.
struct SeparatedErrors {
  std::optional<double> total;  ///< error at the base
  std::optional<double> spacing, time_step, compressibility, precision;
  std::optional<double> spacing_order;
};
SeparatedErrors separate(const std::vector<Measurement>& measurements, const ValidationCase& which, std::string_view figure);

/// The cases that have measurements, in their order.
std::vector<const ValidationCase*> casesIn(const AccuracyResults& results);
/// The names of a case's error figures.
std::vector<std::string_view> errorFiguresOf(const ValidationCase& which);

}  // namespace bleedsim::lab
