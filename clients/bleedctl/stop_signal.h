// Ctrl-C and SIGTERM: they end a command that only waits, and let one that has something to close end properly.
#pragma once

#include <chrono>

namespace bleedsim::bleedctl {

/// From now on SIGINT and SIGTERM end the process at once with exit code kInterrupted, also after holdStopSignals().
void endOnStopSignals();

/// From now on they are only noted: for a command that asks waitForStopSignal() all the time and then ends by itself.
void holdStopSignals();

/// Waits for one of them; true when one has come since holdStopSignals().
bool waitForStopSignal(std::chrono::milliseconds timeout);

}  // namespace bleedsim::bleedctl
