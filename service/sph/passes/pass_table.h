// The compiled passes of one SIMD target: one density pass for each boundary kind, one force pass for each set of effects.
#pragma once

#include <array>

#include "service/sph/effects/pair_set.h"
#include "service/sph/passes/pass_jobs.h"
#include "service/sph/world.h"

namespace bleedsim::sph {

template <class Real>
struct PassTable {
  int lanes = 1;
  std::array<std::array<DensityFunction<Real>, 2>, 2> density{};            ///< [periodic][tissue]
  std::array<std::array<ForceFunction<Real>, PairSet::kCount>, 2> force{};  ///< [periodic][set]; null for the empty set
};

/// Null if this build or machine lacks the target. `automatic` gives the best.
const PassTable<float>* findPasses(SimdTarget target);
/// The reference in double precision; scalar only.
const PassTable<double>& referencePasses();

}  // namespace bleedsim::sph
