// The contiguous part of n particles that one share of a pass works on.
#pragma once

#include <cstdint>

namespace bleedsim::sph {

struct ShareRange {
  std::uint32_t begin, end;
  ShareRange(std::uint32_t n, int share, int shares)
      : begin{static_cast<std::uint32_t>(std::uint64_t{n} * static_cast<std::uint64_t>(share) /
                                         static_cast<std::uint64_t>(shares))},
        end{static_cast<std::uint32_t>(std::uint64_t{n} * static_cast<std::uint64_t>(share + 1) /
                                       static_cast<std::uint64_t>(shares))} {}
};

}  // namespace bleedsim::sph
