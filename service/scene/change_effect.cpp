#include "service/scene/change_effect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include "service/scene/auto_effects.h"
#include "service/scene/effect_names.h"
#include "service/scene/effect_removal.h"
#include "service/scene/fill_defaults.h"
#include "service/scene/finish_scene.h"
#include "service/scene/nearest_name.h"
#include "service/scene/read_text.h"

namespace bleedsim::scene {
namespace {

/// With the whole list, which just fits into a reply.
Status unknownEffect(const std::string& name) {
  const std::vector<std::string> known = knownEffects();
  const std::string nearest = nearestName(name, known);
  if (!nearest.empty()) {
    return {StatusCode::not_found, fmt::format("no effect '{}'; did you mean '{}'?", name.substr(0, 32), nearest)};
  }
  return {StatusCode::not_found, fmt::format("no such effect, use {}", fmt::join(known, ", "))};
}

}  // namespace

Result<SceneDescription> changeEffect(const SceneDescription& scene, const EffectChange& change, const Session& session) {
  const google::protobuf::FieldDescriptor* field = findEffect(change.name);
  if (field == nullptr) return unknownEffect(change.name);
  Scene message;
  ProblemList problems;
  if (!readText(scene.normalized_text, message, problems)) return problems.firstToStatus();

  Effects& effects = *message.mutable_effects();
  const google::protobuf::Reflection& reflection = *effects.GetReflection();
  SettingsMemory former = scene.former_settings;
  const bool was_on = reflection.HasField(effects, field);
  if (was_on) former[change.name] = writeText(reflection.GetMessage(effects, field));
  leaveAuto(change.name, effects);
  if (change.enabled) {
    const auto remembered = former.find(change.name);
    const std::string& settings = change.settings.empty() && remembered != former.end() ? remembered->second : change.settings;
    reflection.ClearField(&effects, field);
    if (!readText(settings, *reflection.MutableMessage(&effects, field), problems)) return problems.firstToStatus();
  } else if (!change.settings.empty()) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("effects.{}: settings are for an effect that goes on; leave them out", change.name)};
  } else {
    removeEffect(change.name, message);
  }
  Result<SceneDescription> changed = finishScene(message, problems, session);
  if (!changed) return problems.firstToStatus();
  changed->former_settings = std::move(former);
  return changed;
}

Result<SceneDescription> reopenScene(std::string_view text, SettingsMemory former_settings, const Session& session) {
  Scene message;
  ProblemList problems;
  if (!readText(text, message, problems)) return problems.firstToStatus();
  Result<SceneDescription> decided = finishScene(message, problems, session);
  if (!decided) return problems.firstToStatus();
  decided->former_settings = std::move(former_settings);
  return decided;
}

Result<SceneDescription> decideAgain(const SceneDescription& scene, const Session& session) {
  return reopenScene(scene.normalized_text, scene.former_settings, session);
}

}  // namespace bleedsim::scene
