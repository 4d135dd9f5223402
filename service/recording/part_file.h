// A file that grows under another name: what stood under its own is lost only when the new one is whole.
#pragma once

#include <filesystem>

#include "service/status/status.h"

namespace bleedsim::recording {

/// Removes what it has written, unless keep() was called.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& target);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  /// To write to; in the folder of the target.
  const std::filesystem::path& path() const { return part_; }
  /// Gives the file its name. io: says why not.
  ::bleedsim::Status keep();

 private:
  std::filesystem::path target_;
  std::filesystem::path part_;
  bool done_ = false;
};

/// invalid_argument: `to` is `from`, or there is something there that is no file.
::bleedsim::Status checkTarget(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace bleedsim::recording
