// Random identities of sessions and clients.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace bleedsim::transport {

using Uuid = std::array<std::uint8_t, 16>;

/// A random (version 4) UUID from the kernel's generator.
Uuid drawUuid();
/// A random number other than 0, for the run of a client.
std::uint64_t drawRun();
/// 8-4-4-4-12 lower-case hexadecimal digits.
std::string toString(const Uuid& uuid);

inline Uuid toUuid(const std::uint8_t (&bytes)[16]) {
  Uuid out;
  std::memcpy(out.data(), bytes, out.size());
  return out;
}
inline void copyUuid(const Uuid& from, std::uint8_t (&to)[16]) { std::memcpy(to, from.data(), from.size()); }

}  // namespace bleedsim::transport
