#include <fmt/format.h>

#include "service/scene/convert.h"
#include "service/scene/fill_defaults.h"
#include "service/scene/problem_list.h"
#include "service/scene/read_text.h"
#include "service/scene/scene.h"
#include "service/scene/validate.h"

namespace bleedsim::scene {

Result<SceneDescription> parseScene(std::string_view text) {
  if (text.size() > kMaxSceneBytes) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the scene text has {} bytes, allowed are at most {}; shorten it", text.size(), kMaxSceneBytes)};
  }
  Scene message;
  ProblemList problems;
  if (readText(text, message, problems)) {
    fillDefaults(message);
    validate(message, problems);
  }
  if (!problems.empty()) return problems.toStatus();
  SceneDescription description = convert(message);
  description.normalized_text = writeText(message);
  return description;
}

}  // namespace bleedsim::scene
