#include "service/recording/channel_map.h"

#include <fmt/core.h>

namespace bleedsim::recording {

Result<std::map<std::uint16_t, Topic>> topicsOf(const mcap::FileIndex& file) {
  std::map<std::uint16_t, Topic> topics;
  for (const auto& [id, channel] : file.channels) {
    for (const TopicInfo& info : kTopics) {
      if (channel.topic != info.channel) continue;
      const auto schema = file.schemas.find(channel.schema_id);
      if (channel.message_encoding != "protobuf" || schema == file.schemas.end() || schema->second.name != info.schema) {
        return ::bleedsim::Status{StatusCode::unsupported,
                                  fmt::format("channel {} does not hold {} messages", info.channel, info.schema)};
      }
      topics[id] = info.topic;
    }
  }
  if (topics.empty() && !file.truncated) {
    return ::bleedsim::Status{StatusCode::unsupported,
                              "this MCAP file holds no channels of bleedsim; open a file that 'bleedctl record' wrote"};
  }
  return topics;
}

}  // namespace bleedsim::recording
