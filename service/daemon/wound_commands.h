// Requests that open, change or close a wound.
#pragma once

#include <optional>

#include "service/dds/request.h"
#include "service/sph/command.h"

namespace bleedsim::daemon {

struct WoundCommand {
  sph::Command command;
  double width = 0.0;  ///< scene::patchWidthOf()
};

/// Nothing for an action that is not a wound's.
std::optional<WoundCommand> woundCommand(const dds::Action& action);

}  // namespace bleedsim::daemon
