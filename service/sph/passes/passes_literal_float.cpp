// Float32 passes of the literal model, compiled for every SIMD target; the scalar twin lives in the baseline target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/sph/passes/passes_literal_float.cpp"
#include <hwy/foreach_target.h>

#include "service/sph/passes/make_literal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {
namespace {

const LiteralTable<float>* tableOf(bool periodic) { return literalTableOf<TargetLanes>(periodic); }

}  // namespace
}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "service/sph/passes/pick_target-inl.h"

namespace bleedsim::sph {

const LiteralTable<float>& literalPasses(SimdTarget target, bool periodic) { return *pickTable(target, periodic); }

}  // namespace bleedsim::sph
#endif
