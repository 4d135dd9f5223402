// The commands of bleedd that simulate nothing.
#pragma once

#include "service/daemon/scene_loader.h"

namespace bleedsim::daemon {

/// --list-effects, to standard output, as a table or as one JSON array. `description` may be null: then without the state in a
/// scene.
void printEffects(const scene::SceneDescription* description, bool json);

/// --check, to standard output: what the world of the scene is like.
void printWorld(const LoadedScene& loaded);

}  // namespace bleedsim::daemon
