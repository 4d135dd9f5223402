// The paper's method in its two faces: as printed, and sound.
#pragma once

#include <string>
#include <vector>

#include "service/lab/paper/paper_options.h"

namespace bleedsim::lab {

struct ModelFace {
  std::string name;  ///< "sound", "literal"
  bool literal = false;
};

/// The models that the options ask for, sound first.
std::vector<ModelFace> facesOf(ModelChoice choice);

/// The scene in that model; the literal one has no core radius (34).
sph::WorldDescription inModel(const sph::WorldDescription& scene, const ModelFace& face);

}  // namespace bleedsim::lab
