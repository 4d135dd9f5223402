// Included once by each file that compiles tables for every SIMD target, after them: picks the table of a target.
#pragma once

#include <hwy/targets.h>

#include "service/sph/simd_target.h"

namespace bleedsim::sph {
namespace {

/// tableOf(choice) of the target's namespace. `target` is one of this build's and not `automatic`.
template <class Choice>
auto pickTable(SimdTarget target, const Choice& choice) {
  switch (target) {
#if HWY_TARGETS & HWY_AVX3
    case SimdTarget::avx512:
      return N_AVX3::tableOf(choice);
#endif
#if HWY_TARGETS & HWY_AVX2
    case SimdTarget::avx2:
      return N_AVX2::tableOf(choice);
#endif
    default:
      return HWY_NAMESPACE::tableOf(choice);
  }
}

}  // namespace
}  // namespace bleedsim::sph
