// Float32 passes with the cubic spline, for pressure and viscosity alone, compiled for every SIMD target; the scalar twin lives
// in the baseline target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/sph/passes/passes_spline.cpp"
#include <hwy/foreach_target.h>

#include "service/sph/passes/make_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {
namespace {

const PassTable<float>* tableOf(bool periodic) {
  static constexpr PassTable<float> kBounded = makeTable<TargetLanes, CubicSpline, false, SetRange::plain>();
  static constexpr PassTable<float> kPeriodic = makeTable<TargetLanes, CubicSpline, true, SetRange::plain>();
  return periodic ? &kPeriodic : &kBounded;
}

}  // namespace
}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "service/sph/passes/float_tables.h"
#include "service/sph/passes/pick_target-inl.h"

namespace bleedsim::sph {

const PassTable<float>* splinePasses(SimdTarget target, bool periodic) { return pickTable(target, periodic); }

}  // namespace bleedsim::sph
#endif
