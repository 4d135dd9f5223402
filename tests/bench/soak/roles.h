// The clients that misbehave in a soak run, each in a process of its own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bleedsim::soak {

struct Place {
  std::uint32_t domain = 0;
  std::string session;
};

/// How the run treats the process of a role from outside.
enum class Treatment {
  leave,  ///< runs as long as the soak
  stall,  ///< stopped (SIGSTOP) and continued, again and again
  kill,   ///< killed (SIGKILL) and started again, again and again
};

struct Role {
  std::string_view name;
  std::string_view what;
  Treatment treatment = Treatment::leave;
};

/// All ten, in the order of the report.
const std::vector<Role>& roles();

/// Plays it until the process is ended from outside; returns an exit code if it cannot.
int play(std::string_view role, const Place& place);

}  // namespace bleedsim::soak
