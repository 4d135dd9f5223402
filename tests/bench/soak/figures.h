// What a soak run measures of the daemon, as a client that behaves sees it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bleedsim::soak {

/// One half of the run.
struct Figures {
  std::vector<double> step_us;     ///< one for each frame: mean cost of its steps
  std::vector<double> ping_ms;     ///< answered by the intake
  std::vector<double> reply_ms;    ///< of commands, answered between two steps
  std::vector<double> memory_mib;  ///< resident, each second
  std::uint64_t frames = 0;
  std::uint64_t gaps = 0;
  std::uint64_t steps = 0;
  std::uint64_t commands_lost = 0;  ///< without an answer
  std::uint64_t busy = 0;
  double wall_s = 0.0;
};

/// The value below which the share `p` of them lies; 0 without any.
double percentile(std::vector<double> values, double p);

/// MiB that the process has resident; 0 if it is gone.
double residentMiB(int pid);

/// Two columns, and loud over quiet.
std::string table(const Figures& quiet, const Figures& loud);
std::string json(const Figures& quiet, const Figures& loud);

}  // namespace bleedsim::soak
