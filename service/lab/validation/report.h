// What a validation run found, for readers and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "service/lab/machine.h"
#include "service/lab/validation/case.h"

namespace bleedsim::lab {

struct CaseOutcome {
  const ValidationCase* which = nullptr;
  Status status;  ///< not ok: the case could not be run
  CaseResult result;
};

struct ValidationRun {
  Knobs knobs;
  Machine machine;
  std::vector<CaseOutcome> outcomes;
};

/// "h = 2.5 dx, 20 across, Mach factor 10, CFL 0.4, float, 1 thread"
std::string lineOf(const Knobs& knobs);

/// The Markdown table of all figures, with the grade of each.
std::string tableOf(const ValidationRun& run);
nlohmann::json toJson(const ValidationRun& run);

/// A line for each figure that misses its threshold and for each case that could not be run.
std::vector<std::string> missesOf(const ValidationRun& run);

/// report.md, with the plots of every case beside it. The folder must exist.
Status writeReport(const std::string& folder, const ValidationRun& run);

}  // namespace bleedsim::lab
