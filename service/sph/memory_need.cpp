#include "service/sph/memory_need.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "service/sph/world_checks.h"

namespace bleedsim::sph {
namespace {

// Bytes for each particle of the capacity, from the arrays of single precision; every effect taken as on.
constexpr double kState = 2 * 12 * 4;      // twice, for the sort
constexpr double kPasses = 4 * 16 + 44;    // record, density, accelerations, places of lists
constexpr double kTissueAndEffects = 144;  // walls 64, scratch 64, rates 8, bodies 8
constexpr double kFrames = 4 * 44;         // three buffers and the sample
// Neighbour lists as PairPasses reserves them; each thread reserves for all and uses its share.
constexpr double kBytesOfEntry = 8.0;  // a neighbour's record and its distance

double listBytes(double support_ratio) {
  return kBytesOfEntry * (1.2 * 4.2 * support_ratio * support_ratio * support_ratio + 24.0);
}

std::optional<std::uint64_t> firstNumber(const std::filesystem::path& file) {
  std::ifstream in{file};
  std::uint64_t number = 0;
  if (in >> number) return number;
  return std::nullopt;
}

/// MemAvailable of /proc/meminfo.
std::optional<std::uint64_t> ofMachine(const std::filesystem::path& root) {
  std::ifstream in{root / "proc/meminfo"};
  for (std::string line; std::getline(in, line);) {
    std::istringstream words{line};
    std::string name;
    std::uint64_t kib = 0;
    if (words >> name >> kib && name == "MemAvailable:") return kib * 1024;
  }
  return std::nullopt;
}

/// The least that is left to the process's control group and those around it.
std::optional<std::uint64_t> ofGroups(const std::filesystem::path& root) {
  std::ifstream in{root / "proc/self/cgroup"};
  std::string line;
  while (std::getline(in, line) && !line.starts_with("0::/")) {}
  if (!line.starts_with("0::/")) return std::nullopt;
  std::optional<std::uint64_t> least;
  const std::filesystem::path top = root / "sys/fs/cgroup";
  std::filesystem::path group = top / line.substr(4);
  for (;;) {
    const auto most = firstNumber(group / "memory.max");  // "max": no limit
    const auto used = firstNumber(group / "memory.current");
    if (most && used) least = std::min(least.value_or(*most), *most - std::min(*most, *used));
    if (group == top || !group.has_relative_path() || group == group.parent_path()) return least;
    group = group.parent_path();
  }
}

constexpr double kMiB = 1024.0 * 1024.0;

}  // namespace

std::uint64_t memoryNeed(const WorldDescription& description, int threads) {
  const double particle = kState + kPasses + kTissueAndEffects + kFrames + listBytes(description.support_ratio);
  const double cells = std::min(gridCells(description.domain, description.supportRadius()), kMostCells);
  return static_cast<std::uint64_t>(particle * description.capacity + 4.0 * (1.0 + threads) * cells);
}

std::optional<std::uint64_t> availableMemory(const std::filesystem::path& root) {
  const auto machine = ofMachine(root);
  const auto groups = ofGroups(root);
  if (!machine || !groups) return machine ? machine : groups;
  return std::min(*machine, *groups);
}

Status checkMemory(const WorldDescription& description, int threads, std::optional<std::uint64_t> available) {
  const std::uint64_t need = memoryNeed(description, threads);
  if (!available || need <= *available) return {};
  const auto mib = [](std::uint64_t bytes) {
    return std::to_string(static_cast<std::uint64_t>(std::ceil(static_cast<double>(bytes) / kMiB))) + " MiB";
  };
  return {StatusCode::capacity, "a capacity of " + std::to_string(description.capacity) + " particles needs " + mib(need) +
                                    " of memory, " + mib(*available) + " are available: lower domain.capacity or free memory"};
}

}  // namespace bleedsim::sph
