// Moves the support radii of the free particles by a law of their density; those of a throat stay at h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "service/sph/executor.h"
#include "service/sph/particles.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

template <class Real>
class RadiusMover {
 public:
  explicit RadiusMover(int shares) : largest_of_share_(static_cast<std::size_t>(shares)) {}

  /// law(density in kg/m^3, radius over h) gives the new radius over h. Returns the largest, at least 1, as new particles have:
  /// how far the next step must search.
  template <class Law>
  Real move(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor, const Law& law) {
    executor.run(shares, [&](int share) {
      const ShareRange range{count, share, shares};
      Real most = Real(1);
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (p.driver[i] != 0) continue;
        p.radius[i] = law(density[i], p.radius[i]);
        most = std::max(most, p.radius[i]);
      }
      largest_of_share_[static_cast<std::size_t>(share)].radius = most;
    });
    Real most = Real(1);
    for (int share = 0; share < shares; ++share) most = std::max(most, largest_of_share_[static_cast<std::size_t>(share)].radius);
    return most;
  }

 private:
  struct alignas(64) Largest {
    Real radius = 1;
  };
  std::vector<Largest> largest_of_share_;
};

}  // namespace bleedsim::sph
