// The results of an accuracy run as a chapter of Markdown, for its own report and for a README.
#pragma once

#include <string>
#include <vector>

#include "service/lab/accuracy/plots.h"
#include "service/lab/accuracy/work_precision.h"

namespace bleedsim::lab {

/// "20 across, h = 2.5 dx, Mach 10, CFL 0.4"
std::string settingText(const Knobs& knobs);

/// Errors and real-time factors of every case at every setting, where the errors come from, what each effect costs, what was left
/// out, and the plots.
std::string chapterOf(const AccuracyResults& results);
/// The plots, `links` before their file names.
std::string picturesOf(const std::vector<WrittenPlot>& plots, const std::string& links);

/// One row for each measurement, with its ranges.
std::string measurementTable(const AccuracyResults& results);

}  // namespace bleedsim::lab
