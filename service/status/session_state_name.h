// The states of a session in words, for logs, the service manager and tools.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

namespace bleedsim {

/// Of a state's number on the wire (STATE_... of idl/bleed.idl); "unknown" for those of a later version.
inline const char* sessionStateName(std::uint32_t number) {
  constexpr const char* kNames[] = {"loading", "running", "paused", "faulted", "stopped"};
  return number < std::size(kNames) ? kNames[number] : "unknown";
}

}  // namespace bleedsim
