#include "service/scene/number_walk.h"

#include <cmath>
#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <string>
#include <vector>

namespace bleedsim::scene {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

std::string pathOf(const std::string& parent, const FieldDescriptor& field) {
  return parent.empty() ? field.name() : fmt::format("{}.{}", parent, field.name());
}

void reportIn(const Message& message, const std::string& path, ProblemList& problems) {
  const Reflection& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const std::string field_path = pathOf(path, *field);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && !field->is_repeated()) {
      const double value = reflection.GetDouble(message, field);
      if (!std::isfinite(value)) problems.add(field_path, fmt::format("value {} is not finite, give a finite number", value));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && field->is_repeated()) {
      for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
        reportIn(reflection.GetRepeatedMessage(message, field, i), fmt::format("{}[{}]", field_path, i), problems);
      }
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      reportIn(reflection.GetMessage(message, field), field_path, problems);
    }
  }
}

void clearIn(Message& message) {
  const Reflection& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && !field->is_repeated()) {
      if (reflection.GetDouble(message, field) == 0.0) reflection.SetDouble(&message, field, 0.0);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && field->is_repeated()) {
      for (int i = 0; i < reflection.FieldSize(message, field); ++i)
        clearIn(*reflection.MutableRepeatedMessage(&message, field, i));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      clearIn(*reflection.MutableMessage(&message, field));
    }
  }
}

}  // namespace

void reportNonFinite(const Scene& scene, ProblemList& problems) { reportIn(scene, "", problems); }

void clearNegativeZeros(Scene& scene) { clearIn(scene); }

}  // namespace bleedsim::scene
