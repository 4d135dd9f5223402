// The scene files of the paper's experiments.
#pragma once

#include <string>
#include <string_view>

#include "service/lab/paper/paper_options.h"
#include "service/scene/scene.h"

namespace bleedsim::lab {

/// NAME.textproto of the options' folder; without one of config/scenes/paper here, or of the source tree that bleedlab was built
/// from. not_found with the places that were tried.
Result<scene::SceneDescription> loadPaperScene(const PaperOptions& options, std::string_view name);

/// The scene's horizon_s, s; invalid_argument if it has none.
Result<double> horizonOf(const scene::SceneDescription& scene);

/// Particles that the scene's wounds bring within its horizon_s.
Result<std::uint32_t> particlesOf(const scene::SceneDescription& scene);

}  // namespace bleedsim::lab
