#include "service/scene/change_resolution.h"

#include <algorithm>

#include "service/scene/effect_names.h"
#include "service/scene/effect_removal.h"
#include "service/scene/finish_scene.h"
#include "service/scene/read_text.h"

namespace bleedsim::scene {

Result<SceneDescription> changeResolution(const SceneDescription& scene, const ResolutionChange& change) {
  Scene message;
  ProblemList problems;
  if (!readText(scene.normalized_text, message, problems)) return problems.toStatus();
  message.mutable_resolution()->set_spacing_m(change.spacing);
  message.mutable_resolution()->set_support_ratio(change.support_ratio);
  message.mutable_compressibility()->set_mach_factor(change.mach_factor);
  message.mutable_domain()->set_capacity(std::max(message.domain().capacity(), change.capacity));
  for (const std::string& name : change.left_out) {
    if (findEffect(name) == nullptr) return Status{StatusCode::not_found, "no effect '" + name + "'"};
    removeEffect(name, message);
  }
  return finishScene(message, problems);
}

}  // namespace bleedsim::scene
