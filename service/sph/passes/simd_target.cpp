#include "service/sph/simd_target.h"

#include <algorithm>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include "service/sph/passes/float_tables.h"
#include "service/sph/passes/literal_table.h"

namespace bleedsim::sph {

std::string_view simdTargetName(SimdTarget target) {
  switch (target) {
    case SimdTarget::automatic:
      return "auto";
    case SimdTarget::scalar:
      return "scalar";
    case SimdTarget::avx2:
      return "avx2";
    case SimdTarget::avx512:
      return "avx512";
  }
  return "auto";
}

Result<SimdTarget> parseSimdTarget(std::string_view name) {
  for (const SimdTarget target : {SimdTarget::automatic, SimdTarget::scalar, SimdTarget::avx2, SimdTarget::avx512}) {
    if (name == simdTargetName(target)) return target;
  }
  return Status{StatusCode::not_found, "unknown SIMD target '" + std::string{name} + "'; use auto, scalar, avx2 or avx512"};
}

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

const PassTable<float>* findPasses(SimdTarget target, const PassChoice& choice) {
  const std::vector<SimdTarget> available = availableSimdTargets();
  if (target == SimdTarget::automatic) target = available.front();
  if (std::find(available.begin(), available.end(), target) == available.end()) return nullptr;
  if (choice.literal) return &literalPasses(target, choice.periodic).passes;
  if (choice.kernel == KernelType::cubic_spline) return splinePasses(target, choice.periodic);
  return choice.periodic ? periodicPasses(target) : boundedPasses(target);
}

}  // namespace bleedsim::sph
