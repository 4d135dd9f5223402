// What a model or a planar world does not have, and why.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

struct ModelProblem {
  std::string field;                 ///< as a scene names it: "effects.adhesion"; of a block what follows it, or nothing
  Status status;                     ///< what is wrong, why, and what to do
  std::optional<std::size_t> block;  ///< of WorldDescription::fluid_blocks
};

/// All that the literal model refuses of a description. Empty for the sound model.
std::vector<ModelProblem> literalProblems(const WorldDescription& description);

/// All that a planar world refuses. Empty for another.
std::vector<ModelProblem> planarProblems(const WorldDescription& description);

/// The first of both, or ok.
Status checkModel(const WorldDescription& description);

}  // namespace bleedsim::sph
