#include "service/lab/machine.h"

#include <array>
#include <cstdlib>
#include <ctime>
#include <fmt/core.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "service/build/build_info.h"
#include "service/sph/world.h"

namespace bleedsim::lab {
namespace {

std::string processorName() {
  std::ifstream file{"/proc/cpuinfo"};
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t start = line.find(": ");
    if (start != std::string::npos) return line.substr(start + 2);
  }
  return "unknown processor";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &utc);
  return text.data();
}

}  // namespace

Machine thisMachine() {
  Machine machine;
  machine.processor = processorName();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.simd = sph::simdTargetName(sph::availableSimdTargets().front());
  const std::string build = buildId();
  machine.version = build.substr(0, build.find(' '));
  machine.date = today();
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0.0;
  return machine;
}

std::string lineOf(const Machine& machine) {
  return fmt::format("{}, {} cores, {}, bleedsim {}, {}, load {:.1f}", machine.processor, machine.cores, machine.simd,
                     machine.version, machine.date, machine.load);
}

nlohmann::json toJson(const Machine& machine) {
  return {{"processor", machine.processor}, {"cores", machine.cores}, {"simd", machine.simd},
          {"version", machine.version},     {"date", machine.date},   {"load", machine.load}};
}

}  // namespace bleedsim::lab
