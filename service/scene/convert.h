// A valid scene message to SI units and the solver's types.
#pragma once

#include "idl/scene.pb.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {

/// The message must have its defaults filled in and no problems. normalized_text is left empty.
SceneDescription convert(const Scene& scene);

/// Parts of it: as far as they have no problems.
sph::WorldDescription convertWorld(const Scene& scene);
sph::Domain convertDomain(const Domain& domain);

}  // namespace bleedsim::scene
