// What was built.
#pragma once

#include <string>

namespace bleedsim::daemon {

/// The project's version, e.g. "1.0.0".
std::string buildVersion();
/// Version, revision of the sources when they were configured, compiler and build type.
std::string buildId();

}  // namespace bleedsim::daemon
