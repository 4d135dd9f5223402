#include "service/scene/effect_removal.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <string_view>
#include <vector>

#include "service/scene/auto_effects.h"
#include "service/scene/effect_names.h"

namespace bleedsim::scene {
namespace {

void dropAttribute(Output& output, Output::Attribute attribute) {
  std::vector<int> kept;
  for (const int value : output.attributes()) {
    if (value != attribute) kept.push_back(value);
  }
  output.mutable_attributes()->Assign(kept.begin(), kept.end());
}

/// What an absent effect would make invalid.
void dropDependents(Scene& scene) {
  if (!scene.effects().has_viscosity()) {
    dropAttribute(*scene.mutable_output(), Output::VISCOSITY);
    for (FluidBlock& block : *scene.mutable_fluid_blocks()) block.clear_viscosity_pa_s();
  }
  if (!scene.effects().has_platelets()) dropAttribute(*scene.mutable_output(), Output::PLATELET);
  if (!scene.effects().has_core_radius()) dropAttribute(*scene.mutable_output(), Output::RADIUS);
}

}  // namespace

void leaveAuto(const std::string& name, Effects& effects) {
  std::vector<std::string> kept;
  for (const std::string& other : effects.auto_()) {
    if (other != name && !(name == "viscosity" && other == kAutoImplicit)) kept.push_back(other);
  }
  effects.mutable_auto_()->Assign(kept.begin(), kept.end());
}

void removeEffect(const std::string& name, Scene& scene) {
  Effects& effects = *scene.mutable_effects();
  leaveAuto(name, effects);
  effects.GetReflection()->ClearField(&effects, findEffect(name));
  dropDependents(scene);
}

}  // namespace bleedsim::scene
