// An effect of a running scene is switched, or gets other settings.
#pragma once

#include <string>
#include <string_view>

#include "service/scene/auto_effects.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {

struct EffectChange {
  std::string name;
  bool enabled = false;
  /// Protobuf text of the effect's message: what it leaves out takes its default. Empty: the settings that the effect had when
  /// it was last on, or its defaults.
  std::string settings;
};

/// The scene as it reads with the change, in the session that runs it. not_found: no such effect, with the list;
/// invalid_argument: the first problem of the settings or of the combination, short enough for a reply. An effect that goes off
/// takes what depends on it alone: its output attribute, the viscosities of fluid blocks. It also leaves effects.auto: who
/// switches by hand has decided.
Result<SceneDescription> changeEffect(const SceneDescription& scene, const EffectChange& change, const Session& session);

/// A scene that a session ran, from the text that acted then, its memory of settings and what the session knew. invalid_argument:
/// the first problem of the text.
Result<SceneDescription> reopenScene(std::string_view text, SettingsMemory former_settings, const Session& session);

/// The scene with the decisions of effects.auto taken anew, because the session knows more than it did.
Result<SceneDescription> decideAgain(const SceneDescription& scene, const Session& session);

}  // namespace bleedsim::scene
