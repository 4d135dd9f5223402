// A file that is written by a thread of its own, so that whoever fills it never waits for the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "service/status/status.h"

namespace bleedsim::recording {

/// One thread writes and closes. Holds at most the limit, one block and what writeEnd() is given in memory.
class WriteQueue {
 public:
  /// Creates or replaces the file. io: says why not.
  static Result<WriteQueue> open(const std::filesystem::path& path, std::size_t limit_bytes);

  WriteQueue(WriteQueue&&) noexcept;
  WriteQueue& operator=(WriteQueue&&) noexcept;
  /// Closes the file; call close() to learn whether that worked.
  ~WriteQueue();

  /// Takes a block; never waits. Of blocks that do not fit the limit the first one is still taken, so that whoever counts what it
  /// handed over is right. io: as status(), the block is not taken.
  ::bleedsim::Status write(std::string block);
  /// Takes a block though too much waits already: for the little that makes the file complete. io: the disk failed.
  ::bleedsim::Status writeEnd(std::string block);
  /// Waits until all blocks are in the file. io: as write().
  ::bleedsim::Status flush();
  /// Waits as flush(), brings the bytes to the disk and closes the file. Further calls give the first answer. io: as status().
  ::bleedsim::Status close();

  /// io: the disk failed, or it was once so slow that more than the limit waited. After the latter what was taken is still
  /// written, and writeEnd() ends the file properly.
  ::bleedsim::Status status() const;

  std::uint64_t bytes() const { return bytes_; }  ///< taken
  std::uint32_t crc() const { return crc_; }      ///< CRC-32 of everything taken

 private:
  struct Impl;
  explicit WriteQueue(std::unique_ptr<Impl> impl);
  ::bleedsim::Status take(std::string block, bool end);

  std::unique_ptr<Impl> impl_;
  std::uint64_t bytes_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace bleedsim::recording
