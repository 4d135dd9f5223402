// How commands on recordings answer when a file is missing, damaged or cut off.
#pragma once

#include <string>

#include "service/status/status.h"

namespace bleedsim::bleedctl {

/// What to do with a file that is not whole.
std::string remedyFor(const std::string& path);

/// Prints why, and for a damaged recording what to do; the exit code. Wrong arguments are kUsage, all else is kFile.
int failOnRecording(const Status& status, const std::string& path);

/// Says on stderr that only a part of the recording was there; nothing for an empty reason.
void warnOfCut(const std::string& path, const std::string& truncation_reason);

}  // namespace bleedsim::bleedctl
