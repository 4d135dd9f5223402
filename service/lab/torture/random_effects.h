// Effects of a random scene, each on by chance, with its defaults or with settings from the whole of their ranges, and switches
// of them while it runs.
#pragma once

#include "idl/scene.pb.h"
#include "service/lab/dice.h"
#include "service/scene/change_effect.h"

namespace bleedsim::lab {

/// Also gives the blocks that are there viscosities and platelets of their own.
void addRandomEffects(Dice& dice, bool literal, scene::Scene& scene);

/// Any effect, mostly the other way than it is in `effects`, which follow. What goes on has the settings that it had, its
/// defaults, or others. What cannot be (platelets without viscosity, adhesion without tissue) is among it, and must be refused.
scene::EffectChange randomChange(Dice& dice, const scene::Scene& scene, scene::Effects& effects);

}  // namespace bleedsim::lab
