#include "service/scene/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace bleedsim::scene {
namespace {

// Bounds the quadratic work; no field's name is nearly as long.
constexpr std::size_t kMaxCompared = 128;

/// Levenshtein 1966: insertions, deletions and replacements, each at cost 1.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  if (name.size() > kMaxCompared) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const std::string& candidate : candidates) {
    // A forgotten unit: "radius" is "radius_m".
    const bool without_unit =
        !name.empty() && candidate.size() > name.size() && candidate.starts_with(name) && candidate[name.size()] == '_';
    if (without_unit) return candidate;
    const std::size_t distance = editDistance(name, candidate);
    if (distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace bleedsim::scene
