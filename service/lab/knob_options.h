// The command line's knobs of validation cases.
#pragma once

#include <optional>
#include <string>

#include "service/lab/app.h"
#include "service/lab/validation/knobs.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// What was given; the rest is the preset's.
struct KnobArguments {
  std::string preset = "standard";
  std::optional<int> across;
  std::optional<double> support_ratio, mach_factor, cfl;
  std::string precision = "float";
  int threads = 1;
  std::string simd = "auto";
};

void addKnobOptions(CLI::App& command, KnobArguments& arguments);
/// invalid_argument for a SIMD target that is unknown, or not there in double precision.
Result<Knobs> knobsOf(const KnobArguments& arguments);

}  // namespace bleedsim::lab
