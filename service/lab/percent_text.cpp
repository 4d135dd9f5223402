#include "service/lab/percent_text.h"

#include <fmt/core.h>

namespace bleedsim::lab {

std::string percentText(const std::optional<double>& error) {
  if (!error) return "-";
  if (*error != 0.0 && *error < 5e-5) return fmt::format("{:.1e}", *error);
  return fmt::format("{:.2f} %", 100.0 * *error);
}

}  // namespace bleedsim::lab
