#include "tests/integration/client/json_value.h"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

namespace bleedsim::client_test {

Json parseJson(const std::string& text) {
  Json value;
  const auto parsed = google::protobuf::util::JsonStringToMessage(text, &value);
  EXPECT_TRUE(parsed.ok()) << parsed.ToString() << "\n" << text;
  return parsed.ok() ? value : Json{};
}

const Json& member(const Json& object, const std::string& key) {
  const auto& fields = object.struct_value().fields();
  const auto found = fields.find(key);
  EXPECT_NE(found, fields.end()) << "no member '" << key << "' in " << object.ShortDebugString();
  return found == fields.end() ? Json::default_instance() : found->second;
}

double number(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  EXPECT_EQ(value.kind_case(), Json::kNumberValue) << key;
  return value.number_value();
}

std::string text(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  EXPECT_EQ(value.kind_case(), Json::kStringValue) << key;
  return value.string_value();
}

}  // namespace bleedsim::client_test
