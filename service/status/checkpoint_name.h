// Names of checkpoints. A name is all that a peer can say of one, never a path: files are named after it. One rule for requests,
// clients and files.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim {

inline constexpr std::size_t kMaxCheckpointName = 48;

/// invalid_argument unless the name is 1 to kMaxCheckpointName letters, digits, '-' or '_', the first a letter or a digit.
inline Status checkCheckpointName(std::string_view name) {
  // Not those of <cctype>, which depend on the locale.
  const auto letter_or_digit = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const auto allowed = [&](char c) { return letter_or_digit(c) || c == '-' || c == '_'; };
  if (!name.empty() && name.size() <= kMaxCheckpointName && letter_or_digit(name.front()) &&
      std::all_of(name.begin(), name.end(), allowed)) {
    return {};
  }
  std::string shown;
  for (const char c : name.substr(0, kMaxCheckpointName)) shown += c >= ' ' && c <= '~' ? c : '?';
  return {StatusCode::invalid_argument, "checkpoint '" + shown + "': use 1 to " + std::to_string(kMaxCheckpointName) +
                                            " letters, digits, '-' or '_', not '-' or '_' first"};
}

/// Names that begin with "auto-" are those of checkpoints that the service takes by itself: it also deletes them.
inline bool isAutomaticCheckpoint(std::string_view name) { return name.starts_with("auto-"); }

}  // namespace bleedsim
