// Where bleedd's log goes: standard error, and a file when asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "service/daemon/log_file.h"

namespace bleedsim::daemon {

struct LogOptions {
  std::string level = "info";       ///< see checkLogLevel
  std::optional<std::string> file;  ///< path; standard error then shows only what needs attention: warnings and errors
};

/// invalid_argument unless it is trace, debug, info, warning, error or off.
Status checkLogLevel(const std::string& level);

/// Makes the process's log. The file to reopen, null without one; io: it cannot be opened.
Result<std::shared_ptr<LogFile>> setUpLog(const LogOptions& options);

}  // namespace bleedsim::daemon
