// From a message that was read to a description.
#pragma once

#include <optional>

#include "idl/scene.pb.h"
#include "service/scene/auto_effects.h"
#include "service/scene/problem_list.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {

/// Fills defaults, validates, converts, decides what effects.auto leaves to us and writes the normalised text. `problems` may
/// hold those of the text; all are told. `session`: that which runs the scene already.
Result<SceneDescription> finishScene(Scene& message, ProblemList& problems, const std::optional<Session>& session = {});

}  // namespace bleedsim::scene
