#include "service/daemon/build_info.h"

namespace bleedsim::daemon {

// BLEEDSIM_... are set for this file alone, so that a new revision does not compile everything again.
std::string buildVersion() { return BLEEDSIM_VERSION; }
std::string buildId() { return BLEEDSIM_VERSION "-" BLEEDSIM_REVISION " " BLEEDSIM_COMPILER " " BLEEDSIM_BUILD_TYPE; }

}  // namespace bleedsim::daemon
