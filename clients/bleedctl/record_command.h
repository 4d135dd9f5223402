// record: a session into an MCAP file.
#pragma once

#include "clients/bleedctl/context.h"

namespace bleedsim::bleedctl {

void addRecord(CLI::App& app, Context& context);

}  // namespace bleedsim::bleedctl
