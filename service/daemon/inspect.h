// The commands of bleedd that simulate nothing.
#pragma once

#include <string>

#include "service/daemon/scene_loader.h"

namespace bleedsim::daemon {

/// --list-effects, as a table or as one JSON object. `description` may be null: then every effect is "available". With one its
/// state there is "on" or "off", and its decisions and warnings follow.
std::string listEffects(const scene::SceneDescription* description, bool json);

/// --check: what the world of the scene is like.
std::string describeWorld(const LoadedScene& loaded);

}  // namespace bleedsim::daemon
