// The layout for Foxglove and Lichtblick that is installed: every topic and field that it names is in our recordings.
#include <algorithm>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "service/recording/point_cloud.h"
#include "service/recording/topics.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

using Json = google::protobuf::Value;

Json layout() {
  Json value;
  const std::string text = readAll(BLEEDSIM_SOURCE_DIR "/config/recording/foxglove_layout.json");
  const auto parsed = google::protobuf::util::JsonStringToMessage(text, &value);
  EXPECT_TRUE(parsed.ok()) << parsed.ToString();
  return value;
}

/// A member of an object; null without.
const Json& at(const Json& object, const std::string& key) {
  const auto& fields = object.struct_value().fields();
  const auto found = fields.find(key);
  return found == fields.end() ? Json::default_instance() : found->second;
}

/// Every text within, names of members included.
void collectTexts(const Json& value, std::vector<std::string>& out) {
  if (value.kind_case() == Json::kStringValue) out.push_back(value.string_value());
  for (const Json& element : value.list_value().values()) collectTexts(element, out);
  for (const auto& [name, member] : value.struct_value().fields()) {
    out.push_back(name);
    collectTexts(member, out);
  }
}

/// Of a channel's messages; null: no recording has this channel.
const google::protobuf::Descriptor* messageOf(const std::string& channel) {
  if (channel == kPointCloudChannel) return foxglove::PointCloud::descriptor();
  for (const TopicInfo& topic : kTopics) {
    if (channel == topic.channel) return Frame::descriptor()->file()->pool()->FindMessageTypeByName(topic.schema);
  }
  return nullptr;
}

/// What is wrong with a path as "/bleed/v1/frame_stats.emitted_ml"; empty: nothing.
std::string problemOf(const std::string& path) {
  std::size_t dot = std::min(path.find('.'), path.size());
  const google::protobuf::Descriptor* message = messageOf(path.substr(0, dot));
  if (message == nullptr) return path + ": no such topic";
  while (dot < path.size()) {
    const std::size_t end = std::min(path.find('.', dot + 1), path.size());
    const std::string name = path.substr(dot + 1, end - dot - 1);
    const google::protobuf::FieldDescriptor* field = message == nullptr ? nullptr : message->FindFieldByName(name);
    if (field == nullptr) return path + ": no field " + name;
    message = field->message_type();
    dot = end;
  }
  return {};
}

TEST(FoxgloveLayout, TheCheckFindsWhatIsNotThere) {
  EXPECT_EQ(problemOf("/bleed/v1/frame_stats.emitted_ml"), "");
  EXPECT_EQ(problemOf("/bleed/v1/frame_stats.emitted_l"), "/bleed/v1/frame_stats.emitted_l: no field emitted_l");
  EXPECT_EQ(problemOf("/bleed/v2/frame"), "/bleed/v2/frame: no such topic");
}

TEST(FoxgloveLayout, NamesOnlyTopicsAndFieldsOfOurSchemas) {
  std::vector<std::string> texts;
  collectTexts(layout(), texts);
  std::set<std::string> paths;
  std::copy_if(texts.begin(), texts.end(), std::inserter(paths, paths.end()),
               [](const std::string& text) { return text.starts_with('/'); });
  EXPECT_GE(paths.size(), 4U) << "points, two plots, the status";
  for (const std::string& path : paths) EXPECT_EQ(problemOf(path), "");
}

TEST(FoxgloveLayout, ColoursPointsByAColumnThatTheyHave) {
  std::mt19937_64 random{1};
  foxglove::PointCloud cloud;
  ASSERT_TRUE(toPointCloud(makeFrame(random, 1, 3), "", cloud).ok());
  std::set<std::string> columns;
  for (const auto& field : cloud.fields()) columns.insert(field.name());
  std::size_t clouds = 0;
  const Json whole = layout();
  for (const auto& [panel, settings] : at(whole, "configById").struct_value().fields()) {
    for (const auto& [topic, look] : at(settings, "topics").struct_value().fields()) {
      EXPECT_EQ(topic, kPointCloudChannel) << panel << " draws points only";
      EXPECT_TRUE(columns.contains(at(look, "colorField").string_value())) << at(look, "colorField").string_value();
      ++clouds;
    }
  }
  EXPECT_EQ(clouds, 1U);
}

TEST(FoxgloveLayout, ArrangesThePanelsThatItDescribes) {
  std::vector<std::string> arranged;
  const Json whole = layout();
  collectTexts(at(whole, "layout"), arranged);
  for (const auto& [panel, settings] : at(whole, "configById").struct_value().fields()) {
    EXPECT_EQ(std::count(arranged.begin(), arranged.end(), panel), 1) << panel;
  }
}

}  // namespace
}  // namespace bleedsim::recording::test
