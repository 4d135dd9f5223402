#include "service/recording/schemas.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <set>
#include <string>

#include "idl/recording.pb.h"

namespace bleedsim::recording {
namespace {

void collect(const google::protobuf::FileDescriptor& file, std::set<std::string>& seen,
             google::protobuf::FileDescriptorSet& out) {
  if (!seen.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) collect(*file.dependency(i), seen, out);
  file.CopyTo(out.add_file());
}

}  // namespace

std::string descriptorSetOf(const google::protobuf::FileDescriptor& file) {
  google::protobuf::FileDescriptorSet set;
  std::set<std::string> seen;
  collect(file, seen, set);
  return set.SerializeAsString();
}

std::vector<mcap::Schema> recordingSchemas() {
  const std::string data = descriptorSetOf(*Frame::descriptor()->file());
  std::vector<mcap::Schema> out;
  for (const TopicInfo& info : kTopics) out.push_back({channelIdOf(info.topic), info.schema, "protobuf", data});
  return out;
}

std::vector<mcap::Channel> recordingChannels() {
  std::vector<mcap::Channel> out;
  for (const TopicInfo& info : kTopics) {
    const std::uint16_t id = channelIdOf(info.topic);
    out.push_back({id, id, info.channel, "protobuf", {{"units", info.units}}});
  }
  return out;
}

}  // namespace bleedsim::recording
