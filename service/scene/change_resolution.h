// A scene at another resolution: what `bleedlab choose` writes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "service/scene/scene.h"

namespace bleedsim::scene {

struct ResolutionChange {
  double spacing = 0.0;        ///< m
  double support_ratio = 0.0;  ///< h/dx
  double mach_factor = 0.0;
  std::uint32_t capacity = 0;         ///< at least; the scene's own stays if it is larger
  std::vector<std::string> left_out;  ///< names of effects that are on and go off
};

/// The scene with the change, validated as a whole; its normalized_text is what to write to a file. invalid_argument as
/// parseScene(); not_found for an effect that there is not.
Result<SceneDescription> changeResolution(const SceneDescription& scene, const ResolutionChange& change);

}  // namespace bleedsim::scene
