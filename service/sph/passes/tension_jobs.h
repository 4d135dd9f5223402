// The two sweeps of surface tension, effects/surface_tension.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

template <class Real>
struct NormalJob : SweepJob<Real> {};

template <class Real>
struct CurvatureJob : SweepJob<Real> {};

}  // namespace bleedsim::sph
