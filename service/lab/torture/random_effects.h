// Effects of a random scene, each on by chance, with its defaults or with settings from the whole of their ranges.
#pragma once

#include "idl/scene.pb.h"
#include "service/lab/dice.h"

namespace bleedsim::lab {

/// Also gives the blocks that are there viscosities and platelets of their own.
void addRandomEffects(Dice& dice, bool literal, scene::Scene& scene);

}  // namespace bleedsim::lab
