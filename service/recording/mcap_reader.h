// Reads the messages of an MCAP file, chunk by chunk. https://mcap.dev/spec
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "service/recording/compression.h"
#include "service/recording/file_source.h"
#include "service/recording/mcap_index.h"
#include "service/recording/mcap_records.h"
#include "service/status/status.h"

namespace bleedsim::recording::mcap {

struct Message {
  MessageHead head;
  ByteView data;  ///< in the loaded chunk
};

class McapReader {
 public:
  /// Errors: as FileSource and readIndex().
  static Result<McapReader> open(const std::filesystem::path& path, Damage damage = Damage::refuse);

  McapReader(McapReader&&) noexcept = default;
  McapReader& operator=(McapReader&&) noexcept = default;

  const FileIndex& index() const { return index_; }
  std::uint64_t fileBytes() const { return file_.bytes(); }

  /// Decompresses and checks a chunk, unless it is the one loaded. data_loss, or unsupported for its compression.
  ::bleedsim::Status loadChunk(std::size_t chunk);
  std::optional<std::size_t> loadedChunk() const { return loaded_; }

  /// The message at or after `position` in the loaded chunk, which becomes the position behind it. False at the chunk's end.
  Result<bool> next(std::uint64_t& position, Message& out) const;

  /// Where a channel's messages stand in a chunk; empty when it has none there. Loads the chunk where the file has no index of
  /// it.
  Result<std::vector<std::uint64_t>> messageOffsets(std::size_t chunk, std::uint16_t channel_id);

  /// Reads the data section once and compares its checksum; a file without one (cut off) passes.
  ::bleedsim::Status verify() const;

 private:
  McapReader(FileSource file, FileIndex index, Decompressor decompressor);
  ::bleedsim::Status damaged(std::uint64_t offset, const std::string& what) const;
  ::bleedsim::Status decompress(const ChunkIndex& chunk, ByteView compressed);
  void dropUnfinishedChunk();

  FileSource file_;
  FileIndex index_;
  Decompressor decompressor_;
  std::vector<std::byte> record_;
  std::vector<std::byte> chunk_;
  std::optional<std::size_t> loaded_;
};

}  // namespace bleedsim::recording::mcap
