// The two sweeps of surface tension, effects/surface_tension.h.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

/// Surface normals. Particle i's record starts with the tissue's share of n h in its normal fields and ends with the fields of
/// RecordField: unit normal and weight, zeros where the particle is no surface.
template <class Real>
struct NormalJob : SweepJob<Real> {
  const std::uint32_t* driver = nullptr;  ///< particles of a throat stand for tissue and are never surface
  Real scale = 0;                         ///< V0/h^3 x the gradient's norm, 1
  Real cutoff = 0;                        ///< of |n| h
  Real* surface = nullptr;                ///< record 0, to write
  Real* normal = nullptr;                 ///< 4 per particle: n h; 1 for a particle of a throat, else 0
};

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
