// The second walk of surface tension, effects/surface_tension.h; the first goes along with the forces (SurfaceNormals).
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

/// Curvature, and the acceleration that follows from it.
template <class Real>
struct CurvatureJob : SweepJob<Real> {
  Real ratio = 0;                ///< the gradient's norm over the weight's
  Real largest = 0;              ///< of |kappa| h
  Real scale = 0;                ///< jump x sigma/(rho0 h^2), m/s^2
  Real damping = 0;              ///< 10 nu V0/h^5 x the gradient's norm, 1/s
  const Real* normal = nullptr;  ///< n h, 4 per particle
  Real* acceleration = nullptr;  ///< of tension alone, 4 per particle, m/s^2; the fourth is 0
};

}  // namespace bleedsim::sph
