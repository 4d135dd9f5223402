// gnuplot as a child process: found on a search path, run without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "service/status/status.h"

namespace bleedsim::picture {

/// The first executable file of that name in the folders of a PATH-like list; empty entries are skipped.
std::optional<std::filesystem::path> findProgram(const std::string& name, const std::string& search_path);

/// Runs `program script` in `folder` with default settings, not the user's, and waits. internal: it failed, with the start of
/// what it said; timed_out: it took longer than `patience_s` and was ended; unavailable: it could not be started.
Status runGnuplot(const std::filesystem::path& program, const std::filesystem::path& folder, const std::string& script,
                  double patience_s);

}  // namespace bleedsim::picture
