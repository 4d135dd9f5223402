// Which effects a world can hold together, and the bounds of the settings of core radius and repulsion.
#pragma once

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// invalid_argument for a setting out of its bounds; unsupported for effects that have no compiled pass together. Every refusal
/// says what to do instead.
Status checkEffectSet(const WorldDescription& description);

}  // namespace bleedsim::sph
