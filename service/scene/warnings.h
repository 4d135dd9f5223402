// What a scene may ask for although it is known to go wrong.
#pragma once

#include <string>
#include <vector>

#include "service/sph/world_description.h"

namespace bleedsim::scene {

/// One text each: "warning: effect: what goes wrong; what to do", short enough for a status. Of what acts, after effects.auto.
std::vector<std::string> findWarnings(const sph::WorldDescription& world);

}  // namespace bleedsim::scene
