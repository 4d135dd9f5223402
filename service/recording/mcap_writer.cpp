#include "service/recording/mcap_writer.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

namespace bleedsim::recording::mcap {

Result<McapWriter> McapWriter::open(const std::filesystem::path& path, const ChunkOptions& options, std::vector<Schema> schemas,
                                    std::vector<Channel> channels) {
  Result<Compressor> compressor = Compressor::create(options.compression, options.zstd_level);
  if (!compressor) return compressor.status();
  Result<WriteQueue> sink = WriteQueue::open(path, options.queue_bytes);
  if (!sink) return sink.status();
  McapWriter writer{std::move(*sink), options, std::move(*compressor), std::move(schemas), std::move(channels)};
  if (::bleedsim::Status status = writer.begin(); !status) return status;
  return writer;
}

McapWriter::McapWriter(WriteQueue sink, const ChunkOptions& options, Compressor compressor, std::vector<Schema> schemas,
                       std::vector<Channel> channels)
    : sink_{std::move(sink)},
      options_{options},
      compressor_{std::move(compressor)},
      schemas_{std::move(schemas)},
      channels_{std::move(channels)} {
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels_.size());
  for (const Channel& channel : channels_) sequences_[channel.id] = 0;
}

::bleedsim::Status McapWriter::begin() {
  buffer_.assign(kMagic);
  appendHeader(buffer_, "", "bleedsim");
  for (const Schema& schema : schemas_) appendRecord(buffer_, schema);
  for (const Channel& channel : channels_) appendRecord(buffer_, channel);
  ::bleedsim::Status status = sink_.write(buffer_);
  return status ? sink_.flush() : status;
}

::bleedsim::Status McapWriter::write(std::uint16_t channel_id, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                                     std::string_view data) {
  if (::bleedsim::Status status = sink_.status(); !status) return status;
  const auto sequence = sequences_.find(channel_id);
  if (sequence == sequences_.end()) {
    return {StatusCode::invalid_argument, fmt::format("channel {} was not declared when the file was opened", channel_id)};
  }
  if (data.size() > kMaxMessageBytes) {
    return {StatusCode::capacity,
            fmt::format("a message of {} bytes is larger than the {} bytes that a recording takes; use fewer "
                        "particles or attributes",
                        data.size(), kMaxMessageBytes)};
  }
  if (!chunk_.empty() && chunk_.size() + data.size() > options_.bytes) {
    if (::bleedsim::Status status = endChunk(Chunk::next); !status) return status;
  }
  if (chunk_.empty()) {
    chunk_first_ns_ = log_time_ns;
    chunk_since_ = std::chrono::steady_clock::now();
  }
  chunk_last_ns_ = log_time_ns;
  MessageIndex& index = indexes_[channel_id];
  index.channel_id = channel_id;
  index.entries.emplace_back(log_time_ns, chunk_.size());
  appendRecord(chunk_, MessageHead{channel_id, sequence->second++, log_time_ns, publish_time_ns}, data);

  if (statistics_.messages == 0) statistics_.first_time_ns = log_time_ns;
  statistics_.last_time_ns = log_time_ns;
  ++statistics_.messages;
  ++statistics_.channel_messages[channel_id];
  // The message is in: that the disk is too slow is said to the next one.
  return chunk_.size() >= options_.bytes || chunkIsOld(std::chrono::steady_clock::now()) ? endChunk(Chunk::next)
                                                                                         : ::bleedsim::Status{};
}

::bleedsim::Status McapWriter::endOldChunk(std::chrono::steady_clock::time_point now) {
  if (chunkIsOld(now)) {
    if (::bleedsim::Status status = endChunk(Chunk::next); !status) return status;
  }
  return sink_.status();
}

::bleedsim::Status McapWriter::endChunk(Chunk which) {
  // Viewers take the start time 0 of an empty chunk for 1970.
  if (chunk_.empty()) return {};
  // Its messages are counted: beyond the queue's limit they wait for the end.
  if (which == Chunk::next && !sink_.status()) return {};
  const Result<std::string_view> compressed = compressor_.compress(chunk_);
  if (!compressed) return compressed.status();

  ChunkIndex index;
  index.first_time_ns = chunk_first_ns_;
  index.last_time_ns = chunk_last_ns_;
  index.offset = sink_.bytes();
  index.compression = chunkName(compressor_.compression());
  index.compressed_bytes = compressed->size();
  index.uncompressed_bytes = chunk_.size();
  buffer_.clear();
  appendRecord(
      buffer_,
      ChunkHead{chunk_first_ns_, chunk_last_ns_, chunk_.size(), crc32(0, bytesOf(chunk_)), index.compression, compressed->size()},
      *compressed);
  index.length = buffer_.size();
  for (auto& [channel, messages] : indexes_) {
    index.message_index_offsets[channel] = index.offset + buffer_.size();
    appendRecord(buffer_, messages);
  }
  index.message_index_bytes = buffer_.size() - index.length;
  chunk_.clear();
  indexes_.clear();
  if (::bleedsim::Status status = which == Chunk::last ? sink_.writeEnd(buffer_) : sink_.write(buffer_); !status) return status;
  appendRecord(chunk_indexes_, index);
  ++statistics_.chunks;
  return {};
}

::bleedsim::Status McapWriter::write(const Metadata& metadata) {
  if (::bleedsim::Status status = endChunk(Chunk::last); !status) return status;
  buffer_.clear();
  appendRecord(buffer_, metadata);
  metadata_indexes_.push_back({sink_.bytes(), buffer_.size(), metadata.name});
  ++statistics_.metadata;
  return sink_.writeEnd(buffer_);
}

std::string McapWriter::summary(std::uint64_t start) const {
  std::string out;
  std::string offsets;
  std::uint64_t group_start = start;
  const auto end_group = [&](Opcode group) {
    const std::uint64_t end = start + out.size();
    if (end != group_start) appendSummaryOffset(offsets, group, group_start, end - group_start);
    group_start = end;
  };
  for (const Schema& schema : schemas_) appendRecord(out, schema);
  end_group(Opcode::schema);
  for (const Channel& channel : channels_) appendRecord(out, channel);
  end_group(Opcode::channel);
  appendRecord(out, statistics_);
  end_group(Opcode::statistics);
  out += chunk_indexes_;
  end_group(Opcode::chunk_index);
  for (const MetadataIndex& index : metadata_indexes_) appendRecord(out, index);
  end_group(Opcode::metadata_index);

  const std::uint64_t offsets_start = start + out.size();
  out += offsets;
  const std::uint32_t crc = crc32(0, bytesOf(out));
  appendFooter(out, start, offsets_start, crc);
  out += kMagic;
  return out;
}

::bleedsim::Status McapWriter::close() {
  ::bleedsim::Status status = endChunk(Chunk::last);
  if (status) {
    buffer_.clear();
    appendDataEnd(buffer_, sink_.crc());
    status = sink_.writeEnd(buffer_);
  }
  if (status) status = sink_.writeEnd(summary(sink_.bytes()));
  ::bleedsim::Status closed = sink_.close();
  return status ? closed : status;
}

}  // namespace bleedsim::recording::mcap
