// bleedd from its options to its exit code.
#pragma once

#include <memory>

#include "service/daemon/log_file.h"
#include "service/daemon/options.h"
#include "service/daemon/signals.h"

namespace bleedsim::daemon {

/// Reports to the log, whose file SIGHUP reopens; null: it has none. `signals` must have been made before any other thread.
ExitCode runProgram(const Options& options, const std::shared_ptr<LogFile>& log_file, SignalWatch& signals);

}  // namespace bleedsim::daemon
