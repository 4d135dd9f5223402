// A bench against an earlier one.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "service/lab/bench/bench.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// What is read of a file that `bleedlab bench --json` wrote.
struct EarlierCase {
  std::string model, scene;
  std::uint32_t particles = 0;
  int threads = 1;
  double updates = 0.0;                  ///< million particle-updates/s
  double microseconds = 0.0;             ///< of a step, per particle
  std::map<std::string, double> stages;  ///< microseconds by name
};
struct EarlierBench {
  std::string processor, build, date;
  int cores = 0;
  std::vector<EarlierCase> cases;
};

/// not_found or io: it cannot be read; data_loss: it is not the result of a bench. The message names the file and what is wrong.
Result<EarlierBench> readBench(const std::filesystem::path& file);
/// Of the file's text; `name` for the message.
Result<EarlierBench> parseBench(const std::string& text, const std::string& name);

/// For each case how many times as fast it is as then, whole and by stages. Cases that only one of the two has are named; where
/// another machine measured then, that comes first. `name`: of the earlier file.
std::string comparisonOf(const BenchOutcome& now, const EarlierBench& then, const std::string& name);

}  // namespace bleedsim::lab
