#include "service/build/build_info.h"

#include <fmt/core.h>

#include "service/build/revision.h"

namespace bleedsim {

// BLEEDSIM_... and the revision are for this file alone, so that a new revision does not compile everything again.
std::string buildVersion() { return BLEEDSIM_VERSION; }
std::string buildId() { return fmt::format("{}-{} {} {}", BLEEDSIM_VERSION, kRevision, BLEEDSIM_COMPILER, BLEEDSIM_BUILD_TYPE); }

}  // namespace bleedsim
