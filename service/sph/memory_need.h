// Memory is asked for once, when a world is made. A system that promises more than it has would kill the process later, so what a
// description needs is compared with what there is before anything is reserved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Bytes that a world of this description and the frames of its capacity come to use, with every effect: a bound from above.
std::uint64_t memoryNeed(const WorldDescription& description, int threads);

/// Bytes that this process may still use: the machine's, or what is left to its control group (v2) where that is less. Nothing
/// where the system does not tell. `root` is where /proc and /sys are.
std::optional<std::uint64_t> availableMemory(const std::filesystem::path& root = "/");

/// capacity, with both figures and what to do, where the description needs more than `available` bytes.
Status checkMemory(const WorldDescription& description, int threads, std::optional<std::uint64_t> available);

}  // namespace bleedsim::sph
