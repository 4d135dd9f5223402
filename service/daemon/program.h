// bleedd from its options to its exit code.
#pragma once

#include "service/daemon/options.h"
#include "service/daemon/signals.h"

namespace bleedsim::daemon {

/// Reports to standard error; `signals` must have been made before any other thread.
ExitCode runProgram(const Options& options, SignalWatch& signals);

}  // namespace bleedsim::daemon
