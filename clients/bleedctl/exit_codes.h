// What bleedctl's exit status means; the same text stands in --help.
#pragma once

#include "service/status/status.h"

namespace bleedsim::bleedctl {

enum ExitCode : int {
  kDone = 0,
  kFailed = 1,         ///< the session refused, something failed, or doctor found problems
  kUsage = 2,          ///< wrong command line, unknown interface or domain
  kNoSession = 3,      ///< the session was not found, did not answer in time, or was lost
  kFile = 4,           ///< a file could not be read or written, or is damaged
  kInterrupted = 130,  ///< Ctrl-C or SIGTERM before it was done
};

inline constexpr const char* kExitCodeText =
    "Exit codes:\n"
    "  0  done\n"
    "  1  the session refused the command, something failed, or doctor found problems\n"
    "  2  wrong command line, domain or interface\n"
    "  3  no such session, no answer within --timeout, or the session was lost\n"
    "  4  a file could not be read or written, or is damaged\n"
    "  130  ended by Ctrl-C or SIGTERM before it was done\n";

/// For failures of the client library.
ExitCode exitCodeOf(const Status& status);

}  // namespace bleedsim::bleedctl
