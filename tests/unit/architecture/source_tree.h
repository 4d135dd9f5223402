// The files of the repository as the architecture tests see them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bleedsim::tests {

struct SourceFile {
  std::string path;  ///< relative to the root, with '/'
  std::vector<std::string> lines;
};

/// The top of the checkout that this program was built from.
std::filesystem::path sourceRoot();

/// Every regular file below the given folders of the root, in the order of their paths. Throws when a folder is missing.
std::vector<SourceFile> readFiles(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// C++ sources and headers.
bool isCode(std::string_view path);
/// Everything a person writes line by line: code, contracts, scenes, CMake files and scripts.
bool isWrittenByHand(const SourceFile& file);
/// Why the file looks like the output of a tool, or empty.
std::string generatedBecause(const SourceFile& file);
/// Whether the name may stand at the top of the repository.
bool mayStandAtTop(std::string_view name);

}  // namespace bleedsim::tests
