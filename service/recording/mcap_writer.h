// Writes an MCAP file: channels first, then compressed chunks with their message indexes, then the summary. https://mcap.dev/spec
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "service/recording/compression.h"
#include "service/recording/mcap_records.h"
#include "service/recording/write_queue.h"
#include "service/status/status.h"

namespace bleedsim::recording::mcap {

struct ChunkOptions {
  Compression compression = Compression::zstd;
  int zstd_level = 1;
  std::size_t bytes = std::size_t{1} << 20;
  std::chrono::milliseconds age{800};
  std::size_t queue_bytes = std::size_t{64} << 20;  ///< that may wait for the disk
};

/// Largest message that is written and read.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{256} << 20;

/// The order of calls: open with all schemas and channels, write messages and metadata, close. Log times must not fall. Nothing
/// but open() and close() waits for the disk; a disk that is too slow for that ends the messages, see WriteQueue::status().
class McapWriter {
 public:
  static Result<McapWriter> open(const std::filesystem::path& path, const ChunkOptions& options, std::vector<Schema> schemas,
                                 std::vector<Channel> channels);

  McapWriter(McapWriter&&) noexcept = default;
  McapWriter& operator=(McapWriter&&) noexcept = default;

  /// The channel must be one of those given to open(). capacity: more than kMaxMessageBytes. io: as WriteQueue::status().
  ::bleedsim::Status write(std::uint16_t channel_id, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                           std::string_view data);
  /// Hands the open chunk to the disk when it is as old as `age` at `now`: to be called from time to time, since a chunk
  /// otherwise waits for the next message. io: as WriteQueue::status().
  ::bleedsim::Status endOldChunk(std::chrono::steady_clock::time_point now);
  /// Ends the chunk first, so that the record stands after the messages that it is about. Taken though the disk is too slow: what
  /// a recording tells of itself belongs to its end. io: the disk failed.
  ::bleedsim::Status write(const Metadata& metadata);
  /// Waits until what was written is in the file, the open chunk excepted.
  ::bleedsim::Status flush() { return sink_.flush(); }
  ::bleedsim::Status close();

  std::uint64_t bytes() const { return sink_.bytes(); }

 private:
  McapWriter(WriteQueue sink, const ChunkOptions& options, Compressor compressor, std::vector<Schema> schemas,
             std::vector<Channel> channels);
  ::bleedsim::Status begin();
  bool chunkIsOld(std::chrono::steady_clock::time_point now) const {
    return !chunk_.empty() && now - chunk_since_ >= options_.age;
  }
  /// Hands the open chunk to the queue: as one of many, or as part of the file's end.
  enum class Chunk { next, last };
  ::bleedsim::Status endChunk(Chunk which);
  std::string summary(std::uint64_t start) const;

  WriteQueue sink_;
  ChunkOptions options_;
  Compressor compressor_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;

  std::string chunk_;  ///< records of the open chunk
  std::string buffer_;
  std::chrono::steady_clock::time_point chunk_since_;
  std::uint64_t chunk_first_ns_ = 0;
  std::uint64_t chunk_last_ns_ = 0;
  std::map<std::uint16_t, MessageIndex> indexes_;  ///< of the open chunk

  std::map<std::uint16_t, std::uint32_t> sequences_;
  std::string chunk_indexes_;  ///< records: all that grows with the file
  std::vector<MetadataIndex> metadata_indexes_;
  Statistics statistics_;
};

}  // namespace bleedsim::recording::mcap
