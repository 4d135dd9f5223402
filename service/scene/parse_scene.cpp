#include <algorithm>
#include <fmt/format.h>

#include "service/scene/auto_effects.h"
#include "service/scene/convert.h"
#include "service/scene/fill_defaults.h"
#include "service/scene/finish_scene.h"
#include "service/scene/read_text.h"
#include "service/scene/validate.h"
#include "service/scene/warnings.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

/// Lets effects.auto act on the description; what is left out takes its name and its attribute along.
void decide(const Scene& message, const std::optional<Session>& session, SceneDescription& description) {
  std::optional<double> horizon;
  if (message.has_horizon_s()) horizon = message.horizon_s();
  const auto& names = message.effects().auto_();
  if (session) description.narrowest_wound = session->narrowest_wound;
  const double reach = description.world.effects.surface_tension ? tensionReach(description.world) : 0.0;
  for (const AutoDecision& decision : applyAuto({names.begin(), names.end()}, horizon, session, description.world)) {
    description.decisions.push_back(
        fmt::format("auto: {} {}: {}", decision.name, decision.enabled ? "on" : "off", decision.reason));
    if (decision.enabled) continue;
    std::erase(description.effects, decision.name);
    if (decision.name == kAutoTension) description.tension_below = reach;
    if (decision.name == kAutoPlatelets) description.attributes &= ~std::uint32_t{sph::kFramePlatelet};
  }
}

}  // namespace

Result<SceneDescription> finishScene(Scene& message, ProblemList& problems, const std::optional<Session>& session) {
  fillDefaults(message);
  validate(message, problems);
  validateWorld(message, session ? std::optional{session->speed_of_sound} : std::nullopt, problems);
  if (!problems.empty()) return problems.toStatus();
  SceneDescription description = convert(message);
  description.normalized_text = writeText(message);
  decide(message, session, description);
  description.warnings = findWarnings(description.world);
  return description;
}

Result<SceneDescription> parseScene(std::string_view text) {
  if (text.size() > kMaxSceneBytes) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the scene text has {} bytes, allowed are at most {}; shorten it", text.size(), kMaxSceneBytes)};
  }
  Scene message;
  ProblemList problems;
  if (!readText(text, message, problems)) return problems.toStatus();
  return finishScene(message, problems);
}

}  // namespace bleedsim::scene
