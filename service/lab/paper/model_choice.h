// The paper's method in its two faces, each with a scene file of its own: as printed, and sound.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "service/lab/paper/paper_options.h"
#include "service/status/status.h"

namespace bleedsim::lab {

struct ModelFace {
  std::string name;  ///< "sound", "literal"
  bool literal = false;
};

/// The models that the options ask for, sound first.
std::vector<ModelFace> facesOf(ModelChoice choice);

/// What the experiment's scene describes: EXPERIMENT.textproto, or EXPERIMENT_literal.textproto.
Result<sph::WorldDescription> loadFace(const PaperOptions& options, std::string_view experiment, const ModelFace& face);

}  // namespace bleedsim::lab
