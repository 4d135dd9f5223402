// The tissue of a recorded scene, as pictures show it.
#pragma once

#include <vector>

#include "idl/scene.pb.h"
#include "service/picture/shapes.h"

namespace bleedsim::bleedctl {

/// Pieces of a kind that this version does not know, or that make no shape, are left out.
std::vector<picture::Shape> tissueShapes(const scene::Scene& scene);

}  // namespace bleedsim::bleedctl
