// What this host calls itself.
#pragma once

#include <string>

namespace bleedsim::transport {

/// "unknown" when the system does not tell.
std::string hostName();

}  // namespace bleedsim::transport
