// Float32 passes with Wendland C2, compiled for every SIMD target; the scalar twin lives in the baseline target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/sph/passes/passes_float.cpp"
#include <hwy/foreach_target.h>

#include "service/sph/passes/make_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
using TargetLanes = WideLanes;
#else
using TargetLanes = ScalarLanes<float>;
#endif

const PassTable<float>* floatPasses() {
  static constexpr PassTable<float> kTable = makeTable<TargetLanes>();
  return &kTable;
}

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <hwy/targets.h>

namespace bleedsim::sph {

std::vector<SimdTarget> availableSimdTargets() {
  std::vector<SimdTarget> targets;
  [[maybe_unused]] const std::int64_t supported = hwy::SupportedTargets();
#if HWY_TARGETS & HWY_AVX3
  if (supported & HWY_AVX3) targets.push_back(SimdTarget::avx512);
#endif
#if HWY_TARGETS & HWY_AVX2
  if (supported & HWY_AVX2) targets.push_back(SimdTarget::avx2);
#endif
  targets.push_back(SimdTarget::scalar);
  return targets;
}

const PassTable<float>* findPasses(SimdTarget target) {
  const std::vector<SimdTarget> available = availableSimdTargets();
  if (target == SimdTarget::automatic) target = available.front();
  if (std::find(available.begin(), available.end(), target) == available.end()) return nullptr;
  switch (target) {
#if HWY_TARGETS & HWY_AVX3
    case SimdTarget::avx512:
      return N_AVX3::floatPasses();
#endif
#if HWY_TARGETS & HWY_AVX2
    case SimdTarget::avx2:
      return N_AVX2::floatPasses();
#endif
    default:
      return HWY_STATIC_DISPATCH(floatPasses)();
  }
}

}  // namespace bleedsim::sph
#endif
