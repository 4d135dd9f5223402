// The schemas and channels that every recording starts with.
#pragma once

#include <google/protobuf/descriptor.h>
#include <string>
#include <vector>

#include "service/recording/mcap_records.h"
#include "service/recording/topics.h"

namespace bleedsim::recording {

/// MCAP ids count from 1: a schema id of 0 means "none".
constexpr std::uint16_t channelIdOf(Topic topic) { return static_cast<std::uint16_t>(static_cast<unsigned>(topic) + 1U); }

/// A serialised FileDescriptorSet with all imports of the file, each after what it imports.
std::string descriptorSetOf(const google::protobuf::FileDescriptor& file);

/// In the order of Topic; the data are a FileDescriptorSet with all imports.
std::vector<mcap::Schema> recordingSchemas();
std::vector<mcap::Channel> recordingChannels();

}  // namespace bleedsim::recording
