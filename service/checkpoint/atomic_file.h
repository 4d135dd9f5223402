// A file that is there whole or not at all, whatever ends the process or the machine.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <span>

#include "service/status/status.h"

namespace bleedsim::checkpoint {

/// What a file has while it is being written, beside its name.
inline constexpr const char* kPartSuffix = ".part";

/// Writes the parts one after the other into a file beside `path`, brings it to the disk, renames it and brings the folder to the
/// disk. io: the message says what failed; what was at `path` is then still there, unless only the last step failed.
Status writeAtomically(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts);

}  // namespace bleedsim::checkpoint
