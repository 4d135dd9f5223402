#include "service/recording/mcap_reader.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <utility>

namespace bleedsim::recording::mcap {

McapReader::McapReader(FileSource file, FileIndex index, Decompressor decompressor)
    : file_{std::move(file)}, index_{std::move(index)}, decompressor_{std::move(decompressor)} {}

Result<McapReader> McapReader::open(const std::filesystem::path& path, Damage damage) {
  Result<FileSource> file = FileSource::open(path);
  if (!file) return file.status();
  Result<FileIndex> index = readIndex(*file, damage);
  if (!index) return index.status();
  Result<Decompressor> decompressor = Decompressor::create();
  if (!decompressor) return decompressor.status();
  McapReader reader{std::move(*file), std::move(*index), std::move(*decompressor)};
  if (reader.index_.truncated) reader.dropUnfinishedChunk();
  return reader;
}

// The end of a file that was cut off may have its length but not its bytes.
void McapReader::dropUnfinishedChunk() {
  if (index_.chunks.empty()) return;
  const std::size_t last = index_.chunks.size() - 1;
  if (const ::bleedsim::Status status = loadChunk(last); status.code() == StatusCode::data_loss) {
    index_.truncation_reason += fmt::format("; the last chunk, at byte {}, is not usable", index_.chunks[last].offset);
    index_.chunks.pop_back();
  }
}

::bleedsim::Status McapReader::damaged(std::uint64_t offset, const std::string& what) const {
  return {StatusCode::data_loss, fmt::format("'{}' is damaged at byte {}: {}", file_.name(), offset, what)};
}

::bleedsim::Status McapReader::decompress(const ChunkIndex& chunk, ByteView compressed) {
  const auto size = static_cast<std::size_t>(chunk.uncompressed_bytes);
  const ::bleedsim::Status status = decompressor_.decompress(chunk.compression, compressed, size, chunk_);
  if (status.code() == StatusCode::data_loss) return damaged(chunk.offset, status.message());
  return status.ok() ? status : ::bleedsim::Status{status.code(), fmt::format("'{}': {}", file_.name(), status.message())};
}

::bleedsim::Status McapReader::loadChunk(std::size_t chunk) {
  if (loaded_ == chunk) return {};
  loaded_.reset();
  if (chunk >= index_.chunks.size()) {
    return {StatusCode::not_found, fmt::format("there is no chunk {}; the file has {}", chunk, index_.chunks.size())};
  }
  const ChunkIndex& entry = index_.chunks[chunk];
  if (::bleedsim::Status status = readRecord(file_, entry.offset, Opcode::chunk, kMaxChunkBytes, record_); !status) return status;
  ChunkHead head;
  std::size_t head_bytes = 0;
  const ByteView record{record_};
  if (!parse(record, head, head_bytes) || head.compressed_bytes > record.size() - head_bytes) {
    return damaged(entry.offset, "a chunk is longer than its record");
  }
  if (record.size() + kRecordHeadBytes != entry.length || head.compressed_bytes != entry.compressed_bytes ||
      head.uncompressed_bytes != entry.uncompressed_bytes || head.compression != entry.compression ||
      head.first_time_ns != entry.first_time_ns || head.last_time_ns != entry.last_time_ns) {
    return damaged(entry.offset, "a chunk contradicts the index");
  }
  const ByteView compressed = record.subspan(head_bytes, static_cast<std::size_t>(head.compressed_bytes));
  if (::bleedsim::Status status = decompress(entry, compressed); !status) return status;
  if (const std::uint32_t crc = crc32(0, chunk_); head.uncompressed_crc != 0 && crc != head.uncompressed_crc) {
    return damaged(entry.offset, fmt::format("the checksum of a chunk is {:08x}, not {:08x}", crc, head.uncompressed_crc));
  }
  loaded_ = chunk;
  return {};
}

Result<bool> McapReader::next(std::uint64_t& position, Message& out) const {
  const ByteView records{chunk_};
  const std::uint64_t chunk_at = loaded_ ? index_.chunks[*loaded_].offset : 0;
  while (loaded_ && position < records.size()) {
    const ByteView rest = records.subspan(static_cast<std::size_t>(position));
    if (rest.size() < kRecordHeadBytes) return damaged(chunk_at, "a chunk ends within a record");
    const RecordHead head = parseRecordHead(rest.first(kRecordHeadBytes));
    if (head.length > rest.size() - kRecordHeadBytes) return damaged(chunk_at, "a record is longer than its chunk");
    const ByteView content = rest.subspan(kRecordHeadBytes, static_cast<std::size_t>(head.length));
    position += kRecordHeadBytes + head.length;
    if (head.opcode != Opcode::message) continue;
    if (!parse(content, out.head)) return damaged(chunk_at, "a message is too short");
    out.data = content.subspan(kMessageHeadBytes);
    return true;
  }
  return false;
}

Result<std::vector<std::uint64_t>> McapReader::messageOffsets(std::size_t chunk, std::uint16_t channel_id) {
  if (chunk >= index_.chunks.size()) {
    return ::bleedsim::Status{StatusCode::not_found, fmt::format("there is no chunk {}", chunk)};
  }
  const ChunkIndex& entry = index_.chunks[chunk];
  std::vector<std::uint64_t> offsets;
  // A cut may fall between a chunk and its message indexes.
  if (index_.truncated || entry.message_index_offsets.empty()) {
    if (::bleedsim::Status status = loadChunk(chunk); !status) return status;
    std::uint64_t position = 0;
    for (;;) {
      Message message;
      const std::uint64_t before = position;
      Result<bool> more = next(position, message);
      if (!more) return more.status();
      if (!*more) return offsets;
      if (message.head.channel_id == channel_id) offsets.push_back(before);
    }
  }
  const auto place = entry.message_index_offsets.find(channel_id);
  if (place == entry.message_index_offsets.end()) return offsets;
  std::vector<std::byte> content;
  if (::bleedsim::Status status = readRecord(file_, place->second, Opcode::message_index, kMaxRecordBytes, content); !status) {
    return status;
  }
  MessageIndex index;
  if (!parse(content, index) || index.channel_id != channel_id) return damaged(place->second, "a message index is malformed");
  offsets.reserve(index.entries.size());
  for (const auto& [time, offset] : index.entries) {
    if (offset >= entry.uncompressed_bytes) return damaged(place->second, "a message index points outside its chunk");
    offsets.push_back(offset);
  }
  return offsets;
}

::bleedsim::Status McapReader::verify() const {
  constexpr std::uint64_t kDataEndBytes = kRecordHeadBytes + sizeof(std::uint32_t);
  if (index_.truncated) return {};
  if (index_.summary_start < kMagic.size() + kDataEndBytes) return damaged(0, "there is no room for data before the index");
  const std::uint64_t end = index_.summary_start - kDataEndBytes;
  std::vector<std::byte> content;
  if (::bleedsim::Status status = readRecord(file_, end, Opcode::data_end, sizeof(std::uint32_t), content); !status)
    return status;
  if (content.size() != sizeof(std::uint32_t)) return damaged(end, "the end of the data has no checksum");
  std::uint32_t expected = 0;
  for (std::size_t i = 0; i < content.size(); ++i) expected |= static_cast<std::uint32_t>(content[i]) << (8 * i);
  if (expected == 0) return {};

  std::uint32_t crc = 0;
  std::vector<std::byte> buffer(std::size_t{1} << 20);
  for (std::uint64_t at = 0; at < end;) {
    const std::span<std::byte> part{buffer.data(), static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), end - at))};
    if (::bleedsim::Status status = file_.read(at, part); !status) return status;
    crc = crc32(crc, part);
    at += part.size();
  }
  if (crc == expected) return {};
  return damaged(end, fmt::format("the checksum of the data is {:08x}, not {:08x}", crc, expected));
}

}  // namespace bleedsim::recording::mcap
