// The diffusion of platelets between neighbours, effects/platelets-inl.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

template <class Real>
struct PlateletJob : SweepJob<Real> {
  Real scale = 0;                ///< K k/2, m^3/(kg s); K as of viscosity
  Real* acceleration = nullptr;  ///< 4 per particle; the fourth gets dP/dt by diffusion, 1/s
};

}  // namespace bleedsim::sph
