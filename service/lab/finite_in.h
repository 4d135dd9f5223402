// CLI11's own range lets NaN through, because it compares with nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "service/status/number_text.h"

namespace bleedsim::lab {

/// Accepts finite numbers from `lower` to `upper`, both included.
inline CLI::Validator finiteIn(double lower, double upper) {
  return {[lower, upper](std::string& text) { return checkNumberText(text, lower, upper).message(); }, {}};
}

}  // namespace bleedsim::lab
