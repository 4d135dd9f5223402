// The compiled passes of one SIMD target, kernel and kind of boundary: density passes, and one force pass for each set of
// effects.
#pragma once

#include <array>

#include "service/sph/effects/pair_set.h"
#include "service/sph/passes/pass_jobs.h"
#include "service/sph/simd_target.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {

template <class Real>
struct PassTable {
  int lanes = 1;
  std::array<std::array<DensityFunction<Real>, 2>, 2> density{};  ///< [tissue][core radius]; null if not compiled
  std::array<ForceFunction<Real>, PairSet::kCount> force{};       ///< [set]; null if not compiled
};

/// What a table is for.
struct PassChoice {
  KernelType kernel = KernelType::wendland_c2;
  bool periodic = false;
  bool literal = false;  ///< the literal model's density pass with poly6, whatever the kernel; no force passes (literal_table.h)
};

/// Null if this build or machine lacks the target. `automatic` gives the best.
const PassTable<float>* findPasses(SimdTarget target, const PassChoice& choice);
/// The reference in double precision; scalar only.
const PassTable<double>& referencePasses(const PassChoice& choice);

}  // namespace bleedsim::sph
