// The defaults of idl/scene.proto.
#pragma once

#include "idl/scene.pb.h"

namespace bleedsim::scene {

/// Writes every default into the message and puts it into one form: equal scenes become equal messages. Required fields that are
/// missing stay missing. Idempotent.
void fillDefaults(Scene& scene);
/// The same for the effects alone.
void fillEffects(Effects& effects);

}  // namespace bleedsim::scene
