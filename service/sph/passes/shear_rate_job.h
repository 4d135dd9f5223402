// The pair sums behind each particle's shear rate, effects/shear_rate.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

/// Scalars per particle in ShearRateJob::moments: row a = 0..2 holds A_ax, A_ay, A_az, B_aa; then B_xy, B_yz, B_xz and a zero.
constexpr std::size_t kShearMoments = 16;

template <class Real>
struct ShearRateJob : SweepJob<Real> {
  Real scale = 0;           ///< m x gradient norm/h^3, kg/m^3: times 1/rho_j and the kernel's gradient it makes B near 1
  Real* moments = nullptr;  ///< A in m/s (A h of the header), B dimensionless
};

}  // namespace bleedsim::sph
