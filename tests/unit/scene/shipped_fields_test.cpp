// The shipped scenes are the reference of the format: each field of idl/scene.proto is used in one of them.
// it.
#include <filesystem>
#include <fstream>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <string>

#include "idl/scene.pb.h"

namespace bleedsim::scene {
namespace {

void collectFields(const google::protobuf::Descriptor& type, std::set<std::string>& fields) {
  // Vec2 and Vec3 are explained where they are used.
  if (&type == Vec2::descriptor() || &type == Vec3::descriptor()) return;
  for (int i = 0; i < type.field_count(); ++i) {
    fields.insert(type.field(i)->name());
    if (type.field(i)->message_type() != nullptr) collectFields(*type.field(i)->message_type(), fields);
  }
}

std::string shippedText() {
  std::string text;
  for (const auto& entry : std::filesystem::recursive_directory_iterator{BLEEDSIM_SCENE_DIR}) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file{entry.path()};
    text.append(std::istreambuf_iterator<char>{file}, {});
  }
  return text;
}

/// A use of the field: its name at the start of a line or behind a brace, before ':' or ' {'.
bool isUsed(const std::string& text, const std::string& field) {
  for (std::size_t at = text.find(field); at != std::string::npos; at = text.find(field, at + 1)) {
    const std::size_t line = text.rfind('\n', at) + 1;
    const std::string before = text.substr(line, at - line);
    const char after = at + field.size() < text.size() ? text[at + field.size()] : '\n';
    const bool starts = before.find_first_not_of(' ') == std::string::npos || before.ends_with("{ ");
    if (starts && before.find('#') == std::string::npos && (after == ':' || after == ' ')) return true;
  }
  return false;
}

TEST(ShippedScenes, UseEveryFieldBetweenThem) {
  std::set<std::string> fields;
  collectFields(*Scene::descriptor(), fields);
  ASSERT_GT(fields.size(), 50u);
  const std::string text = shippedText();
  for (const std::string& field : fields) EXPECT_TRUE(isUsed(text, field)) << field << " is in no scene under config/scenes";
}

}  // namespace
}  // namespace bleedsim::scene
