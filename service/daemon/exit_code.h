// How bleedd ends.
#pragma once

namespace bleedsim::daemon {

enum class ExitCode : int {
  ok = 0,
  failure = 1,     ///< middleware, interface, system
  usage = 2,       ///< command line, domain, log file or scene
  name_taken = 3,  ///< another daemon runs the session
};

}  // namespace bleedsim::daemon
