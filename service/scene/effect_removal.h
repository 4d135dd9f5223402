// Takes an effect out of a scene's message.
#pragma once

#include <string>

#include "idl/scene.pb.h"

namespace bleedsim::scene {

/// The effect must be a field of Effects. It takes what depends on it alone along (its output attribute, the viscosities of fluid
/// blocks) and leaves effects.auto.
void removeEffect(const std::string& name, Scene& scene);

/// The name, and what is decided about it alone, no longer stand in effects.auto.
void leaveAuto(const std::string& name, Effects& effects);

}  // namespace bleedsim::scene
