#include "service/sph/world.h"

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

}  // namespace bleedsim::sph
