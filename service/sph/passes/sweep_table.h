// The sweeps over the neighbour lists beside the fused force pass: what some effects need before or after it, or not in every
// step. They are compiled
// apart from the force passes, once for each kind of boundary, and an effect that is absent runs none of them.
#pragma once

#include "service/sph/passes/curvature_job.h"
#include "service/sph/passes/pass_jobs.h"
#include "service/sph/passes/pass_table.h"
#include "service/sph/passes/platelet_job.h"
#include "service/sph/passes/shear_rate_job.h"
#include "service/sph/passes/viscous_product_job.h"

namespace bleedsim::sph {

template <class Job>
using SweepFunction = void (*)(const Job&);

template <class Real>
struct SweepTable {
  SweepFunction<ShearRateJob<Real>> shear_rate = nullptr;
  SweepFunction<PlateletJob<Real>> platelets = nullptr;
  SweepFunction<CurvatureJob<Real>> curvature = nullptr;
  SweepFunction<ViscousProductJob<Real>> viscous_product = nullptr;  ///< viscosity differs between particles
  SweepFunction<ViscousProductJob<Real>> uniform_viscous_product = nullptr;
};

/// Which variants: with periodic sides, with a support radius of each particle's own. Wendland C2 only.
struct SweepChoice {
  bool periodic = false;
  bool core_radius = false;
};

/// Null if this build or machine lacks the target. `automatic` gives the best.
const SweepTable<float>* findSweeps(SimdTarget target, const SweepChoice& choice);
/// The reference in double precision; scalar only.
const SweepTable<double>& referenceSweeps(const SweepChoice& choice);

}  // namespace bleedsim::sph
