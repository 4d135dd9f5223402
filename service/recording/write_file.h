// Whole files and the folders that they go into.
#pragma once

#include <filesystem>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim::recording {

/// With its parents, when it is missing. io: says why not.
::bleedsim::Status createFolder(const std::filesystem::path& folder);
/// Creates or replaces the file. io: says why not.
::bleedsim::Status writeFile(const std::filesystem::path& path, std::string_view content);

}  // namespace bleedsim::recording
