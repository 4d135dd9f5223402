// The command line of bleedd.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "service/daemon/exit_code.h"
#include "service/daemon/log.h"
#include "service/dds/request.h"
#include "service/sph/world.h"

namespace bleedsim::daemon {

struct Options {
  std::optional<std::string> scene;  ///< path
  std::string session;
  std::uint32_t domain = 0;
  std::string interface;  ///< empty: loopback
  dds::Pace pace;
  std::optional<double> frame_rate;  ///< frames per simulated second
  std::optional<double> duration;    ///< simulated s, those before a resume included
  sph::WorldOptions world;
  std::optional<double> checkpoint_every;        ///< simulated s
  std::optional<std::string> checkpoint_folder;  ///< of this session; without it no checkpoints are kept
  bool resume = false;
  bool check = false;
  bool list_effects = false;
  bool json = false;  ///< of list_effects
  LogOptions log;
};

/// The options, or the code to exit with once help, version or a usage error was printed.
std::variant<Options, ExitCode> parseOptions(int argc, const char* const* argv);

}  // namespace bleedsim::daemon
