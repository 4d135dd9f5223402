// Every effect that a model has, on top of those of a description.
#pragma once

#include "service/sph/world_description.h"

namespace bleedsim::lab {

/// Adds the effects that the description lacks, with their default settings. Adhesion comes where there is tissue, what the
/// literal model or a planar world does not know stays away.
void addEveryEffect(sph::WorldDescription& scene);

}  // namespace bleedsim::lab
