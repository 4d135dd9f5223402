// Requests that open, change or close a wound.
#pragma once

#include <optional>

#include "service/dds/request.h"
#include "service/sph/command.h"

namespace bleedsim::daemon {

/// Nothing for an action that is not a wound's.
std::optional<sph::Command> woundCommand(const dds::Action& action);

/// The narrowest place of the patch that a command brings, m; infinite without one.
double patchWidthOf(const sph::Command& command);

}  // namespace bleedsim::daemon
