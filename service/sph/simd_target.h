// The instruction sets that the passes are compiled for.
#pragma once

#include <string_view>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::sph {

enum class SimdTarget { automatic, scalar, avx2, avx512 };

/// "auto", "scalar", "avx2", "avx512"
std::string_view simdTargetName(SimdTarget target);
/// not_found with the list of names if the name is unknown.
Result<SimdTarget> parseSimdTarget(std::string_view name);
/// The targets that this build holds and this machine can run, best first, scalar last.
std::vector<SimdTarget> availableSimdTargets();

}  // namespace bleedsim::sph
