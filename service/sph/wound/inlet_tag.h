// The driver tag of a particle that a wound's throat moves: slot 10 bits, site 16 bits, serial 6 bits. 0 is a free particle.
#pragma once

#include <cstdint>

namespace bleedsim::sph {

inline constexpr std::uint32_t kMaxInletSlots = 1023;

struct InletTag {
  std::uint32_t slot = 0;    ///< 1..1023
  std::uint32_t site = 0;    ///< 0..65535
  std::uint32_t serial = 0;  ///< of the particle at its site, modulo 64

  friend bool operator==(const InletTag&, const InletTag&) = default;
};

constexpr std::uint32_t packInletTag(const InletTag& tag) {
  return (tag.slot & 0x3ffu) << 22 | (tag.site & 0xffffu) << 6 | (tag.serial & 0x3fu);
}

constexpr InletTag unpackInletTag(std::uint32_t tag) {
  return {.slot = tag >> 22, .site = (tag >> 6) & 0xffffu, .serial = tag & 0x3fu};
}

}  // namespace bleedsim::sph
