// One product with the matrix of the implicit viscosity, effects/implicit_viscosity.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

template <class Real>
struct ViscousProductJob : SweepJob<Real> {};

}  // namespace bleedsim::sph
