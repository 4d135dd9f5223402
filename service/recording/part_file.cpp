#include "service/recording/part_file.h"

#include <fmt/core.h>
#include <system_error>
#include <unistd.h>

#include "service/status/file_error.h"

namespace bleedsim::recording {

namespace fs = std::filesystem;

PartFile::PartFile(const fs::path& target) : target_{target}, part_{target} { part_ += fmt::format(".part{}", ::getpid()); }

PartFile::~PartFile() {
  std::error_code ignored;
  if (!done_) fs::remove(part_, ignored);
}

::bleedsim::Status PartFile::keep() {
  std::error_code error;
  fs::rename(part_, target_, error);
  if (error) return {StatusCode::io, fmt::format("cannot create '{}': {}", target_.string(), fileErrorText(error.value()))};
  done_ = true;
  return {};
}

::bleedsim::Status checkTarget(const fs::path& from, const fs::path& to) {
  if (std::error_code error; fs::equivalent(from, to, error)) {
    return {StatusCode::invalid_argument, fmt::format("'{}' is the recording itself: write into another file", to.string())};
  }
  if (std::error_code error; fs::exists(to, error) && !fs::is_regular_file(to, error)) {
    return {StatusCode::invalid_argument, fmt::format("'{}' is no regular file: give the name of a file to write", to.string())};
  }
  return {};
}

}  // namespace bleedsim::recording
