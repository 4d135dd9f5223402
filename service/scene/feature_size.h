// How narrow a wound's patch is: what effects.auto measures it by.
#pragma once

#include "service/sph/command.h"
#include "service/sph/world_description.h"

namespace bleedsim::scene {

/// The narrowest place of a patch, m: the diameter of a disc, the small axis of an ellipse, the width of a polyline. Of a polygon
/// the diameter of the widest circle inside, to 0.1 %, or less where it has a neck, as bent slits do all along. Where a slender
/// limb that narrows leaves a wider place, that is a neck; a place that only narrows to a tip is none.
double patchWidth(const sph::PatchShape& shape);

/// Of the patch that a command brings; infinite without one.
double patchWidthOf(const sph::Command& command);

}  // namespace bleedsim::scene
