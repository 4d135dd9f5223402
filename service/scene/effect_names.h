// The effects of a scene by their names, which are those of the fields of the message Effects.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "idl/scene.pb.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {

/// Those that are on.
std::vector<std::string> enabledEffects(const Effects& effects);

/// The field of an effect, or null.
const google::protobuf::FieldDescriptor* findEffect(std::string_view name);

}  // namespace bleedsim::scene
