// The files of an accuracy run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/lab/accuracy/work_precision.h"

namespace bleedsim::lab {

/// One line for each measurement, with a header.
std::string csvOf(const AccuracyResults& results);
/// Markdown: measurements, errors separated, what was left out.
std::string tablesOf(const AccuracyResults& results);
nlohmann::json toJson(const AccuracyResults& results);

/// accuracy.csv, accuracy.md and the plots: work_CASE, spacing, time_step, compressibility, effects_cost. The folder must exist.
Status writeReport(const std::string& folder, const AccuracyResults& results);

}  // namespace bleedsim::lab
