// Float32 passes with Wendland C2 without periodic sides, compiled for every SIMD target; the scalar twin lives in the baseline
// target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/sph/passes/passes_bounded.cpp"
#include <hwy/foreach_target.h>

#include "service/sph/passes/make_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {
namespace {

const PassTable<float>* tableOf(bool) {
  static constexpr PassTable<float> kTable = makeTable<TargetLanes, WendlandC2, false, SetRange::all>();
  return &kTable;
}

}  // namespace
}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "service/sph/passes/float_tables.h"
#include "service/sph/passes/pick_target-inl.h"

namespace bleedsim::sph {

const PassTable<float>* boundedPasses(SimdTarget target) { return pickTable(target, false); }

}  // namespace bleedsim::sph
#endif
