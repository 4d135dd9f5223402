// Ctrl-C and SIGTERM as something to wait for, so that files are closed properly.
#pragma once

#include <chrono>

namespace bleedsim::bleedctl {

/// Blocks SIGINT and SIGTERM for this thread and those it starts: to be called first.
void blockStopSignals();

/// Waits for one of them; true when it came.
bool waitForStopSignal(std::chrono::milliseconds timeout);

}  // namespace bleedsim::bleedctl
