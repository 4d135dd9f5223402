// The plots of an accuracy run.
#pragma once

#include <string>
#include <vector>

#include "service/lab/accuracy/work_precision.h"

namespace bleedsim::lab {

struct WrittenPlot {
  std::string name;     ///< of its files
  std::string picture;  ///< file name; empty without gnuplot
};

/// work_CASE (CPU time against error, with the Pareto front and real time), spacing, time_step, compressibility and effects_cost,
/// those that have something to show. The folder must exist.
Result<std::vector<WrittenPlot>> writePlots(const std::string& folder, const AccuracyResults& results);

}  // namespace bleedsim::lab
