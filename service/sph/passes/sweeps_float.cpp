// Float32 sweeps, compiled for every SIMD target; the scalar twin lives in the baseline target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/sph/passes/sweeps_float.cpp"
#include <hwy/foreach_target.h>

#include "service/sph/passes/make_sweeps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {
namespace {

const SweepTable<float>* tableOf(const SweepChoice& choice) { return sweepsOf<TargetLanes>(choice); }

}  // namespace
}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

#include "service/sph/passes/pick_target-inl.h"

namespace bleedsim::sph {

const SweepTable<float>* findSweeps(SimdTarget target, const SweepChoice& choice) {
  const std::vector<SimdTarget> available = availableSimdTargets();
  if (target == SimdTarget::automatic) target = available.front();
  if (std::find(available.begin(), available.end(), target) == available.end()) return nullptr;
  return pickTable(target, choice);
}

}  // namespace bleedsim::sph
#endif
