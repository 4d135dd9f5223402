// One product with the matrix of the implicit viscosity, effects/implicit_viscosity.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

/// The vector stands in the records' velocity fields.
template <class Real>
struct ViscousProductJob : SweepJob<Real> {
  Real scale = 0;           ///< 5 x ForceJob::viscosity_scale
  Real* product = nullptr;  ///< 4 per particle: viscous acceleration of the vector; the mean diagonal of its block (<= 0)
};

}  // namespace bleedsim::sph
