// Requests that open, change or close a wound.
#pragma once

#include <optional>

#include "service/dds/request.h"
#include "service/sph/command.h"

namespace bleedsim::daemon {

/// The narrowest place of the patch that a command brings, m; infinite without one.
double patchWidthOf(const sph::Command& command);

struct WoundCommand {
  sph::Command command;
  double width = 0.0;  ///< patchWidthOf()
};

/// Nothing for an action that is not a wound's.
std::optional<WoundCommand> woundCommand(const dds::Action& action);

}  // namespace bleedsim::daemon
