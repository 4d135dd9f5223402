#include "service/transport/names.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::transport {

const char* topicName(Topic topic) {
  switch (topic) {
    case Topic::frame:
      return "bleed/v1/frame";
    case Topic::frame_stats:
      return "bleed/v1/frame_stats";
    case Topic::scene:
      return "bleed/v1/scene";
    case Topic::status:
      return "bleed/v1/status";
    case Topic::instrument:
      return "bleed/v1/instrument";
    case Topic::request:
      return "bleed/v1/request";
    case Topic::reply:
      return "bleed/v1/reply";
    case Topic::journal:
      return "bleed/v1/journal";
  }
  return "";
}

bool validSessionName(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kMaxSessionName && std::all_of(name.begin(), name.end(), allowed);
}

Status checkSessionName(std::string_view name) {
  if (validSessionName(name)) return {};
  return {StatusCode::invalid_argument, fmt::format("session name '{}' is not valid: use 1 to {} letters, digits, '_' or '-'",
                                                    name.substr(0, kMaxSessionName + 16), kMaxSessionName)};
}

}  // namespace bleedsim::transport
