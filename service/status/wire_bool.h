// Booleans that come from outside.
#pragma once

#include <cstdint>
#include <cstring>

namespace bleedsim {

/// A boolean from the wire may hold any byte; reading it as bool would be undefined, so its storage is looked at.
inline bool isSet(const bool& flag) {
  std::uint8_t storage = 0;
  std::memcpy(&storage, &flag, sizeof storage);
  return storage != 0;
}

}  // namespace bleedsim
