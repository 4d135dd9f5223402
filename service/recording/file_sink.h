// An output file that counts what goes into it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim::recording {

/// After a failed write the sink stays failed and answers every call with the first error.
class FileSink {
 public:
  /// Creates or replaces the file. io: says why not.
  static Result<FileSink> open(const std::filesystem::path& path);

  FileSink(FileSink&& other) noexcept;
  FileSink& operator=(FileSink&& other) noexcept;
  ~FileSink();

  ::bleedsim::Status write(std::string_view bytes);
  /// Brings the bytes to the disk and closes the file.
  ::bleedsim::Status close();
  /// Closes without waiting for the disk.
  ::bleedsim::Status closeQuickly();

  std::uint64_t bytes() const { return bytes_; }
  const ::bleedsim::Status& status() const { return status_; }

 private:
  FileSink(std::filesystem::path path, int descriptor) : path_{std::move(path)}, descriptor_{descriptor} {}
  ::bleedsim::Status closeAfter(int sync_error);
  ::bleedsim::Status fail(int error, const char* action);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
  ::bleedsim::Status status_;
};

}  // namespace bleedsim::recording
