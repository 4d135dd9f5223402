// The hard cases that were run, as a table for readers and as JSON for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "service/lab/hardcases/hard_case.h"
#include "service/lab/machine.h"

namespace bleedsim::lab {

struct CaseReport {
  const HardCase* hard_case = nullptr;
  std::vector<CaseSetup> setups;
  std::vector<HardOutcome> outcomes;  ///< of the setups
};

/// The columns are a model with a choice of effects each; a cell says whether the case holds in float and in double, and which
/// judged figure came nearest to its bound, or broke it. The machine stands above.
std::string toMarkdown(const std::vector<CaseReport>& reports, const Machine& machine);
/// {"machine": of machine.h, "cases": [...]}
nlohmann::json toJson(const std::vector<CaseReport>& reports, const Machine& machine);

/// "distance, dx 0.31 (at least 0.05)"
std::string describe(const HardFigure& figure);
/// Every judged figure that does not hold, and why the case stopped; empty if it holds.
std::string describeFailures(const HardOutcome& outcome);
/// "sound, all effects, float"
std::string describe(const CaseSetup& setup);

}  // namespace bleedsim::lab
