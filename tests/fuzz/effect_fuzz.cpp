// Settings of an effect request, for a scene that runs.
#include <string>
#include <utility>

#include "service/scene/change_effect.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/flat_scene.h"

namespace {

using namespace bleedsim;

std::string sceneText() {
  return test::FlatScene{.effects = "gravity {} pressure {} viscosity {} platelets {} applied_force {}", .more = test::kCut}
      .text();
}

}  // namespace

/// The first byte says which effect and whether it goes on, the others are its settings.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kNames[] = {"gravity",     "pressure",  "viscosity", "surface_tension", "wetting",       "platelets",
                                    "core_radius", "repulsion", "adhesion",  "applied_force",   "no_such_effect"};
  static const Result<scene::SceneDescription> running = scene::parseScene(sceneText());
  fuzz::require(running.ok(), "the scene of this target is valid");
  fuzz::FuzzInput input{data, size};
  const auto choice = input.take<std::uint8_t>();
  scene::EffectChange change{kNames[choice % std::size(kNames)], choice < 224, {}};
  change.settings.assign(reinterpret_cast<const char*>(input.rest().data()), input.rest().size());
  scene::Session session;
  session.speed_of_sound = 3.0;
  const Result<scene::SceneDescription> changed = scene::changeEffect(*running, change, session);
  if (!changed) {
    fuzz::require(!changed.status().message().empty(), "a refusal has a reason");
    return 0;
  }
  fuzz::require(scene::parseScene(changed->normalized_text).ok(), "the changed scene is valid");
  return 0;
}
