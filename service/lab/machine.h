// Which machine and build measured: stands beside every figure that is kept.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bleedsim::lab {

struct Machine {
  std::string processor;  ///< as the system names it
  int cores = 0;          ///< that the system offers
  std::string simd;       ///< that the solver chooses
  std::string version;    ///< of bleedsim, with the revision of its sources
  std::string date;       ///< UTC, YYYY-MM-DD
  double load = 0.0;      ///< mean number of runnable tasks over the last minute: others shared the machine if it is large
};

Machine thisMachine();

/// "AMD EPYC, 2 cores, avx512, bleedsim 1.0, 2026-11-26, load 0.3"
std::string lineOf(const Machine& machine);
nlohmann::json toJson(const Machine& machine);

}  // namespace bleedsim::lab
