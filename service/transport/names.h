// The topics of protocol version 1 and the names of sessions.
#pragma once

#include <cstddef>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim::transport {

enum class Topic { frame, frame_stats, scene, status, instrument, request, reply, journal };

/// Every topic, for tables and tests.
inline constexpr Topic kTopics[] = {Topic::frame,      Topic::frame_stats, Topic::scene, Topic::status,
                                    Topic::instrument, Topic::request,     Topic::reply, Topic::journal};

/// The name on the wire: "bleed/v1/" and the topic. Its number is the protocol's major version.
const char* topicName(Topic topic);

inline constexpr std::size_t kMaxSessionName = 64;
inline constexpr const char* kDefaultSession = "bleed";
/// The partition that sees every session: for discovery only.
inline constexpr const char* kAnySession = "*";

/// A session's name is its partition: 1 to 64 of A-Z a-z 0-9 _ - (wildcards would join it to other sessions).
bool validSessionName(std::string_view name);
/// ok, or invalid_argument with a message that says what a name may hold.
Status checkSessionName(std::string_view name);

}  // namespace bleedsim::transport
