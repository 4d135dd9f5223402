// The float32 tables by the file that compiles them. `target` is one of this build's and not `automatic`.
#pragma once

#include "service/sph/passes/pass_table.h"

namespace bleedsim::sph {

const PassTable<float>* boundedPasses(SimdTarget target);
const PassTable<float>* periodicPasses(SimdTarget target);
const PassTable<float>* splinePasses(SimdTarget target, bool periodic);

}  // namespace bleedsim::sph
