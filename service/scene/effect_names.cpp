#include "service/scene/effect_names.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

namespace bleedsim::scene {
namespace {

using google::protobuf::FieldDescriptor;

bool isEffect(const FieldDescriptor& field) { return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE; }

}  // namespace

std::vector<std::string> knownEffects() {
  std::vector<std::string> names;
  const google::protobuf::Descriptor& type = *Effects::descriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    if (isEffect(*type.field(i))) names.push_back(type.field(i)->name());
  }
  return names;
}

std::vector<std::string> enabledEffects(const Effects& effects) {
  std::vector<std::string> names;
  for (const std::string& name : knownEffects()) {
    if (effects.GetReflection()->HasField(effects, findEffect(name))) names.push_back(name);
  }
  return names;
}

const FieldDescriptor* findEffect(std::string_view name) {
  const FieldDescriptor* field = Effects::descriptor()->FindFieldByName(std::string{name});
  return field != nullptr && isEffect(*field) ? field : nullptr;
}

}  // namespace bleedsim::scene
