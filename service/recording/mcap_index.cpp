#include "service/recording/mcap_index.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/core.h>
#include <utility>

namespace bleedsim::recording::mcap {
namespace {

::bleedsim::Status damaged(const FileSource& file, std::uint64_t offset, const std::string& what) {
  return {StatusCode::data_loss, fmt::format("'{}' is damaged at byte {}: {}", file.name(), offset, what)};
}

bool isMagic(ByteView bytes) {
  const ByteView magic = bytesOf(kMagic);
  return std::equal(bytes.begin(), bytes.end(), magic.begin(), magic.end());
}

/// Of a chunk index in the summary.
::bleedsim::Status checkChunk(const FileSource& file, const ChunkIndex& chunk, std::uint64_t data_end) {
  if (chunk.offset > data_end || chunk.length > data_end - chunk.offset || chunk.length < kRecordHeadBytes ||
      chunk.compressed_bytes > chunk.length) {
    return damaged(file, chunk.offset, fmt::format("the index names a chunk of {} bytes outside the data", chunk.length));
  }
  if (chunk.uncompressed_bytes > kMaxChunkBytes || chunk.length > kMaxChunkBytes) {
    return damaged(file, chunk.offset,
                   fmt::format("a chunk of {} bytes is larger than {} bytes, the most that is read",
                               std::max(chunk.uncompressed_bytes, chunk.length), kMaxChunkBytes));
  }
  for (const auto& [channel, offset] : chunk.message_index_offsets) {
    if (offset < chunk.offset || offset >= data_end) {
      return damaged(file, chunk.offset, fmt::format("the message index of channel {} stands outside the data", channel));
    }
  }
  return {};
}

/// Reads the summary's records into `out`, and lists where metadata stand.
::bleedsim::Status readSummary(const FileSource& file, ByteView summary, std::uint64_t start, FileIndex& out,
                               std::vector<MetadataIndex>& metadata) {
  std::size_t at = 0;
  while (at < summary.size()) {
    const std::uint64_t place = start + at;
    if (summary.size() - at < kRecordHeadBytes) return damaged(file, place, "the index ends within a record");
    const RecordHead head = parseRecordHead(summary.subspan(at, kRecordHeadBytes));
    at += kRecordHeadBytes;
    if (head.length > summary.size() - at) return damaged(file, place, "a record is longer than the index");
    const ByteView content = summary.subspan(at, static_cast<std::size_t>(head.length));
    at += content.size();

    bool fits = true;
    if (head.opcode == Opcode::schema) {
      Schema schema;
      fits = parse(content, schema);
      out.schemas[schema.id] = std::move(schema);
    } else if (head.opcode == Opcode::channel) {
      Channel channel;
      fits = parse(content, channel);
      out.channels[channel.id] = std::move(channel);
    } else if (head.opcode == Opcode::chunk_index) {
      ChunkIndex chunk;
      fits = parse(content, chunk);
      if (fits) {
        if (::bleedsim::Status status = checkChunk(file, chunk, start); !status) return status;
      }
      out.chunks.push_back(std::move(chunk));
    } else if (head.opcode == Opcode::metadata_index) {
      fits = parse(content, metadata.emplace_back());
    }
    if (!fits)
      return damaged(file, place, fmt::format("record 0x{:02x} of the index is too short", static_cast<unsigned>(head.opcode)));
  }
  return {};
}

/// Of a file that starts as an MCAP file.
Result<FileIndex> readIndexAfterMagic(const FileSource& file, Damage damage) {
  constexpr std::size_t kTailBytes = kRecordHeadBytes + kFooterBytes + kMagic.size();
  if (file.bytes() < kMagic.size() + kTailBytes) return scanIndex(file, "the file ends after its first bytes", damage);

  std::array<std::byte, kTailBytes> tail{};
  const std::uint64_t footer_at = file.bytes() - kTailBytes;
  if (::bleedsim::Status status = file.read(footer_at, tail); !status) return status;
  const ByteView tail_view{tail};
  const RecordHead head = parseRecordHead(tail_view.first(kRecordHeadBytes));
  if (!isMagic(tail_view.last(kMagic.size())) || head.opcode != Opcode::footer || head.length != kFooterBytes) {
    return scanIndex(file, "the index at the end is missing, so the recording was not closed, or is still being written", damage);
  }
  Footer footer;
  if (!parse(tail_view.subspan(kRecordHeadBytes, kFooterBytes), footer))
    return damaged(file, footer_at, "the footer is too short");
  if (footer.summary_start == 0) return scanIndex(file, "the file was written without an index", damage);
  if (footer.summary_start < kMagic.size() || footer.summary_start > footer_at ||
      footer_at - footer.summary_start > kMaxRecordBytes) {
    return damaged(file, footer_at, fmt::format("the footer places the index at byte {}", footer.summary_start));
  }

  std::vector<std::byte> summary(static_cast<std::size_t>(footer_at - footer.summary_start));
  if (::bleedsim::Status status = file.read(footer.summary_start, summary); !status) return status;
  const std::uint32_t crc = crc32(crc32(0, summary), tail_view.first(kRecordHeadBytes + kFooterBytes - sizeof(std::uint32_t)));
  if (footer.summary_crc != 0 && footer.summary_crc != crc) {
    return damaged(file, footer.summary_start,
                   fmt::format("the checksum of the index is {:08x}, not {:08x}", crc, footer.summary_crc));
  }

  FileIndex out;
  out.summary_start = footer.summary_start;
  std::vector<MetadataIndex> metadata;
  if (::bleedsim::Status status = readSummary(file, summary, footer.summary_start, out, metadata); !status) return status;
  for (const MetadataIndex& index : metadata) {
    if (index.offset >= footer.summary_start) return damaged(file, index.offset, "the index names metadata outside the data");
    std::vector<std::byte> content;
    if (::bleedsim::Status status = readRecord(file, index.offset, Opcode::metadata, kMaxRecordBytes, content); !status)
      return status;
    Metadata record;
    if (!parse(content, record)) return damaged(file, index.offset, "a metadata record is too short");
    out.metadata[record.name] = std::move(record.entries);
  }
  return out;
}

}  // namespace

::bleedsim::Status readRecord(const FileSource& file, std::uint64_t offset, Opcode opcode, std::uint64_t limit,
                              std::vector<std::byte>& content) {
  std::array<std::byte, kRecordHeadBytes> head_bytes{};
  if (::bleedsim::Status status = file.read(offset, head_bytes); !status) return status;
  const RecordHead head = parseRecordHead(head_bytes);
  if (head.opcode != opcode) {
    return damaged(file, offset,
                   fmt::format("record 0x{:02x} where 0x{:02x} is expected", static_cast<unsigned>(head.opcode),
                               static_cast<unsigned>(opcode)));
  }
  if (head.length > limit || head.length > file.bytes() - offset - kRecordHeadBytes) {
    return damaged(file, offset, fmt::format("a record of {} bytes does not fit", head.length));
  }
  content.resize(static_cast<std::size_t>(head.length));
  return file.read(offset + kRecordHeadBytes, content);
}

Result<FileIndex> readIndex(const FileSource& file, Damage damage) {
  std::array<std::byte, kMagic.size()> magic{};
  if (file.bytes() < magic.size()) {
    return ::bleedsim::Status{StatusCode::data_loss,
                              fmt::format("'{}' is no recording: it has {} bytes; give a file that 'bleedctl record' wrote",
                                          file.name(), file.bytes())};
  }
  if (::bleedsim::Status status = file.read(0, magic); !status) return status;
  if (!isMagic(magic)) {
    return ::bleedsim::Status{
        StatusCode::data_loss,
        fmt::format("'{}' is no recording: it does not start as an MCAP file; give one that 'bleedctl record' wrote",
                    file.name())};
  }
  Result<FileIndex> index = readIndexAfterMagic(file, damage);
  if (damage == Damage::refuse || index.status().code() != StatusCode::data_loss) return index;
  return scanIndex(file, index.status().message(), damage);
}

}  // namespace bleedsim::recording::mcap
