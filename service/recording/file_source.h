// An input file, read at any place. Nothing is mapped: a file that shrinks while it is read gives an error, not a signal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "service/status/status.h"

namespace bleedsim::recording {

class FileSource {
 public:
  /// not_found, or io with the reason.
  static Result<FileSource> open(const std::filesystem::path& path);

  FileSource(FileSource&& other) noexcept;
  FileSource& operator=(FileSource&& other) noexcept;
  ~FileSource();

  /// Fills all of `out` from `offset` on. data_loss: the file ends before.
  ::bleedsim::Status read(std::uint64_t offset, std::span<std::byte> out) const;

  /// At the time of opening.
  std::uint64_t bytes() const { return bytes_; }
  std::string name() const { return path_.string(); }

 private:
  FileSource(std::filesystem::path path, int descriptor, std::uint64_t bytes);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
};

}  // namespace bleedsim::recording
