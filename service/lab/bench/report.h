// The outcome of a bench for readers and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/lab/bench/bench.h"

namespace bleedsim::lab {

/// Tables of all cases, under a line that says what the columns are.
std::string tablesOf(const BenchOutcome& outcome);

/// An object with the machine, the build, the ceilings and the array "cases".
nlohmann::json toJson(const BenchOutcome& outcome);

/// "paper, 19683 particles, 1 thread", or with the path of the scene.
std::string titleOf(const MeasuredCase& outcome);

}  // namespace bleedsim::lab
