// An error as it is printed.
#pragma once

#include <optional>
#include <string>

namespace bleedsim::lab {

/// "1.25 %"; below 0.005 % the number itself, "3.2e-06"; "-" of none.
std::string percentText(const std::optional<double>& error);

}  // namespace bleedsim::lab
