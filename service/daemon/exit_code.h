// How bleedd ends.
#pragma once

namespace bleedsim::daemon {

enum class ExitCode : int {
  ok = 0,
  failure = 1,     ///< middleware, system
  usage = 2,       ///< command line, domain, interface or scene
  name_taken = 3,  ///< another daemon runs the session
};

}  // namespace bleedsim::daemon
