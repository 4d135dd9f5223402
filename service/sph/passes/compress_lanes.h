// For each 8-bit mask the numbers of its set lanes, a byte each, lowest first: the permutation that moves them to the front.
#pragma once

#include <array>
#include <cstdint>

namespace bleedsim::sph {

inline constexpr std::array<std::uint64_t, 256> kCompressLanes = [] {
  std::array<std::uint64_t, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    unsigned count = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if (mask >> lane & 1) table[mask] |= std::uint64_t{lane} << (8 * count++);
    }
  }
  return table;
}();

}  // namespace bleedsim::sph
