// What was built.
#pragma once

#include <string>

namespace bleedsim {

/// The project's version, e.g. "1.0.0".
std::string buildVersion();
/// Version, revision of the sources, compiler and build type, e.g. "1.0.0-0123456789ab-dirty GNU-12.2.0 Release". The revision is
/// git's hash of the commit, "-dirty" when tracked files differed from it at the build; "unknown" without git.
std::string buildId();

}  // namespace bleedsim
