// A file that is written by a thread of its own, so that whoever fills it never waits for the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "service/status/status.h"

namespace bleedsim::recording {

/// One thread writes and closes. Holds at most the limit and one block in memory.
class WriteQueue {
 public:
  /// Creates or replaces the file. io: says why not.
  static Result<WriteQueue> open(const std::filesystem::path& path, std::size_t limit_bytes);

  WriteQueue(WriteQueue&&) noexcept;
  WriteQueue& operator=(WriteQueue&&) noexcept;
  /// Closes the file; call close() to learn whether that worked.
  ~WriteQueue();

  /// Takes a block; never waits. io: the disk failed, the block is dropped.
  ::bleedsim::Status write(std::string block);
  /// Waits until all blocks are in the file. io: as write().
  ::bleedsim::Status flush();
  /// Waits as flush(), brings the bytes to the disk and closes the file. Further calls give the first answer. io: as status().
  ::bleedsim::Status close();

  /// io: the disk failed, or it was once so slow that more than the limit waited. Blocks are still taken after the latter: what
  /// was taken is written, and the file can be ended properly.
  ::bleedsim::Status status() const;

  std::uint64_t bytes() const { return bytes_; }  ///< taken
  std::uint32_t crc() const { return crc_; }      ///< CRC-32 of everything taken

 private:
  struct Impl;
  explicit WriteQueue(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
  std::uint64_t bytes_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace bleedsim::recording
