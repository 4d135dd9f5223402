// The files of an accuracy run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "service/lab/accuracy/plots.h"
#include "service/lab/accuracy/work_precision.h"

namespace bleedsim::lab {

/// One line for each figure of each measurement, with a header.
std::string csvOf(const AccuracyResults& results);
nlohmann::json toJson(const AccuracyResults& results);

/// accuracy.csv, accuracy.md and the plots, which go to `plots` too. The folder must exist.
Status writeReport(const std::string& folder, const AccuracyResults& results, std::vector<WrittenPlot>& plots);

}  // namespace bleedsim::lab
