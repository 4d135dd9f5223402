// Cases by the names that a command line gives.
#pragma once

#include <string>
#include <vector>

#include "service/lab/validation/case.h"

namespace bleedsim::lab {

/// Each once, in the order of the catalog; all for no name. not_found with the known ones for a name that is none.
Result<std::vector<const ValidationCase*>> casesOf(const std::vector<std::string>& names);

}  // namespace bleedsim::lab
