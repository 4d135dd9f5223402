// A validation case: physics whose answer is known, run by the solver as it is shipped. ctest and `bleedlab validate` run these
// very functions.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/lab/validation/knobs.h"
#include "service/picture/plot.h"
#include "service/status/status.h"

namespace bleedsim::lab {

enum class Grade { holds, misses, reported };
std::string_view gradeName(Grade grade);

/// One number of a case beside what it should be.
struct Figure {
  std::string name;  ///< a-z, digits and '_'; unique in its case
  double value = 0.0;
  std::optional<double> reference;  ///< none: value is an error itself
  double error = 0.0;               ///< |value/reference - 1|, or |value|
  std::optional<double> bound;      ///< of the error, physics.md section 5; none: reported only
  std::string unit{};               ///< of value and reference; empty: a ratio

  Grade grade() const;
};

/// A value against its reference, which is not 0.
Figure compared(std::string name, double value, double reference, std::optional<double> bound, std::string unit = {});
/// A value that is an error, or that should be 0.
Figure residual(std::string name, double value, std::optional<double> bound);

/// What running worlds took, the first steps of each left out.
struct RunCost {
  std::uint64_t steps = 0;
  std::uint64_t particle_steps = 0;
  double simulated = 0.0;       ///< s
  double cpu = 0.0;             ///< s, of all threads
  double wall = 0.0;            ///< s
  double all_wall = 0.0;        ///< s, with what was left out: what a run of the case takes
  std::uint32_t particles = 0;  ///< of the largest world
  std::uint64_t clamped = 0;    ///< particle-steps whose acceleration or speed the solver cut

  double realTimeFactor() const { return wall > 0.0 ? simulated / wall : 0.0; }
  double microseconds() const { return particle_steps > 0 ? 1e6 * cpu / static_cast<double>(particle_steps) : 0.0; }
};

struct CasePlot {
  std::string name;  ///< of its files
  picture::LinePlot plot;
};

struct CaseResult {
  std::vector<Figure> figures;
  std::vector<CasePlot> plots;
  std::vector<std::string> notes;  ///< what could not be run, and why; what to doubt
  RunCost cost;

  /// Null if there is none of that name.
  const Figure* find(std::string_view name) const;
};

/// Names of figures of a case; those that are empty count for none.
using ErrorFigures = std::array<std::string_view, 3>;

struct ValidationCase {
  std::string_view name;
  int number;  ///< in physics.md section 5; 0: beside them
  std::string_view measures;
  std::string_view reference;  ///< formula and source
  ErrorFigures error_figures;  ///< that stand for the case in work-precision, the first one in its plot
  double cost_power;  ///< p of its run's cost ~ across^p: how many sides have more particles, and how much shorter steps get
  Result<CaseResult> (*run)(const Knobs& knobs);
  std::string_view shortfall = {};  ///< what it comes from where a figure misses its threshold, as far as it was found

  bool measuresAccuracy() const { return !error_figures.front().empty(); }
};

/// In the order of their numbers.
std::span<const ValidationCase> validationCases();
/// Null if there is none of that name.
const ValidationCase* findCase(std::string_view name);

}  // namespace bleedsim::lab
