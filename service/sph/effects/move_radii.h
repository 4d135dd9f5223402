// Moves the support radii of the free particles by a law of their density; those of a throat stay at h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "service/sph/executor.h"
#include "service/sph/particles.h"
#include "service/sph/quad.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

template <class Real>
class RadiusMover {
 public:
  explicit RadiusMover(int shares) : largest_of_share_(static_cast<std::size_t>(shares)) {}

  /// law(density in kg/m^3, radius over h) gives the new radius over h. Returns the largest, at least 1, as new particles have:
  /// how far the next step must search. The law is called without a branch, so that the compiler takes several particles at once
  /// where it has none either.
  template <class Law>
  Real move(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor, const Law& law) {
    executor.run(shares, [&](int share) {
      const ShareRange range{count, share, shares};
      const Law own = law;  // not through the reference, which the radii could change, for all that the compiler knows
      Real* const radius = p.radius.data();
      const std::uint32_t* const driver = p.driver.data();
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const Real moved = own(density[i], radius[i]);
        radius[i] = driver[i] != 0 ? radius[i] : moved;
      }
      using Q = Quad<Real>;
      Real most = Real(1);
      typename Q::Vector most_of_four = Q::set(Real(1));
      inFours(
          range.begin, range.end,
          [&](std::uint32_t i) {
            const typename Q::Vector four = Q::load(radius + i);
            most_of_four = four > most_of_four ? four : most_of_four;
            return true;
          },
          [&](std::uint32_t i) { most = std::max(most, radius[i]); });
      most = std::max(most, Q::largest(most_of_four));
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
