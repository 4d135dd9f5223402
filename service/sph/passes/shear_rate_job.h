// Shear rate of each particle, effects/rheology.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

template <class Real>
struct ShearRateJob : SweepJob<Real> {};

}  // namespace bleedsim::sph
