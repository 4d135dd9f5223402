// Writes an MCAP file: channels first, then zstd chunks with their message indexes, then the summary. https://mcap.dev/spec
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "service/recording/file_sink.h"
#include "service/recording/mcap_records.h"
#include "service/status/status.h"

struct ZSTD_CCtx_s;

namespace bleedsim::recording::mcap {

struct ChunkOptions {
  int compression_level = 1;  ///< zstd
  std::size_t bytes = std::size_t{4} << 20;
  std::uint64_t span_ns = 2'000'000'000;
};

/// Largest message that is written and read.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{256} << 20;

/// The order of calls: open with all schemas and channels, write messages and metadata, close. Log times must not fall.
class McapWriter {
 public:
  static Result<McapWriter> open(const std::filesystem::path& path, const ChunkOptions& options, std::vector<Schema> schemas,
                                 std::vector<Channel> channels);

  McapWriter(McapWriter&&) noexcept = default;
  McapWriter& operator=(McapWriter&&) noexcept = default;

  /// The channel must be one of those given to open(). capacity: more than kMaxMessageBytes. io: as FileSink.
  ::bleedsim::Status write(std::uint16_t channel_id, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                           std::string_view data);
  /// Ends the chunk first, so that the record stands after the messages that it is about.
  ::bleedsim::Status write(const Metadata& metadata);
  ::bleedsim::Status close();

  std::uint64_t bytes() const { return sink_.bytes(); }

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx_s* context) const;
  };

  McapWriter(FileSink sink, const ChunkOptions& options, std::vector<Schema> schemas, std::vector<Channel> channels);
  ::bleedsim::Status begin();
  ::bleedsim::Status endChunk();
  ::bleedsim::Status compress();
  std::string summary(std::uint64_t start) const;

  FileSink sink_;
  ChunkOptions options_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;

  std::string chunk_;       ///< records of the open chunk
  std::string compressed_;  ///< kept for its memory
  std::string buffer_;
  std::uint64_t chunk_first_ns_ = 0;
  std::uint64_t chunk_last_ns_ = 0;
  std::map<std::uint16_t, MessageIndex> indexes_;  ///< of the open chunk

  std::map<std::uint16_t, std::uint32_t> sequences_;
  std::vector<ChunkIndex> chunk_indexes_;
  std::vector<MetadataIndex> metadata_indexes_;
  Statistics statistics_;
};

}  // namespace bleedsim::recording::mcap
