// A planar world's particles feel no force along z: with z and vz of the seeding their layer stays where it is, to the bit.
#pragma once

#include <cstdint>

#include "service/sph/executor.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

/// `acceleration` has four entries a particle.
template <class Real>
void lockLayer(Real* acceleration, std::uint32_t count, int shares, Executor& executor) {
  executor.run(shares, [&](int share) {
    const ShareRange range{count, share, shares};
    for (std::uint32_t i = range.begin; i < range.end; ++i) acceleration[std::size_t{i} * 4 + 2] = Real(0);
  });
}

}  // namespace bleedsim::sph
