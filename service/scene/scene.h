// A scene: protobuf text of idl/scene.proto, checked and turned into what a world is made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/sph/world_description.h"
#include "service/status/request_limits.h"
#include "service/status/status.h"

namespace bleedsim::scene {

/// Longest scene text that is read, bytes.
using bleedsim::kMaxSceneBytes;

/// Settings texts of effects by name.
using SettingsMemory = std::map<std::string, std::string>;

/// A valid scene in SI units.
struct SceneDescription {
  std::string name;
  std::string description;
  std::string frame_id;  ///< coordinate frame of all positions, "bleedsim" if the scene names none
  sph::WorldDescription world;
  double frame_rate = 60.0;            ///< frames per simulated second, 1/s
  std::uint32_t attributes = 0;        ///< sph::FrameAttribute bits of a frame beside positions and ids
  std::optional<double> horizon;       ///< simulated time that the scene is meant for, s
  double instrument_expiry = 0.1;      ///< wall time after which a silent instrument ends, s
  std::string normalized_text;         ///< the scene with every default filled in; parses to this description
  std::vector<std::string> effects;    ///< names of the effects that act, in the order of idl/scene.proto
  std::vector<std::string> decisions;  ///< of effects.auto, each with its reason and figures
  std::vector<std::string> warnings;   ///< what runs but is known to go wrong, each with what to do
  /// effects.auto left surface_tension out: a wound as narrow as this calls for it, m. 0: it did not.
  double tension_below = 0.0;
  /// The narrowest wound by command that the decisions of effects.auto knew of, m; infinite: none.
  double narrowest_wound = std::numeric_limits<double>::infinity();
  SettingsMemory former_settings;  ///< of effects that were switched while the scene ran, see changeEffect()
};

/// Reads and checks a scene. invalid_argument with every problem found, one per line: the field's path (or line:column of the
/// text), the value and what is allowed. The solver's own rules (a wound's speed, room and
/// neighbours) are among them. What the machine lacks, memory or a SIMD target, is left to sph::createWorld.
Result<SceneDescription> parseScene(std::string_view text);

/// Every effect that a scene can name, in the order of idl/scene.proto.
std::vector<std::string> knownEffects();

/// parseScene() of a file. not_found or io if it cannot be read, invalid_argument if it is larger than kMaxSceneBytes or not a
/// valid scene; the message names the path.
Result<SceneDescription> loadScene(const std::filesystem::path& path);

}  // namespace bleedsim::scene
