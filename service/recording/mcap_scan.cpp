// The walk over a file without summary: what a crash or a full disk left behind.

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <utility>

#include "service/recording/mcap_index.h"

namespace bleedsim::recording::mcap {
namespace {

constexpr std::size_t kChunkHeadRoom = 256;  // the members before a chunk's data, with a name of the compression of any use

class Scanner {
 public:
  Scanner(const FileSource& file, Damage damage) : file_{file}, damage_{damage} {}

  ::bleedsim::Status run();
  FileIndex take() { return std::move(index_); }
  const std::string& stop() const { return stop_; }

 private:
  ::bleedsim::Status visit(const RecordHead& head, std::uint64_t offset);
  ::bleedsim::Status visitChunk(const RecordHead& head, std::uint64_t offset);
  ::bleedsim::Status visitMessageIndex(const RecordHead& head, std::uint64_t offset);
  template <class T>
  ::bleedsim::Status load(const RecordHead& head, std::uint64_t offset, T& out);
  ::bleedsim::Status damaged(std::uint64_t offset, const std::string& what) const {
    return {StatusCode::data_loss, fmt::format("'{}' is damaged at byte {}: {}", file_.name(), offset, what)};
  }

  const FileSource& file_;
  Damage damage_;
  FileIndex index_;
  std::string stop_;
};

::bleedsim::Status Scanner::run() {
  std::uint64_t at = kMagic.size();
  while (at < file_.bytes()) {
    if (file_.bytes() - at < kRecordHeadBytes) {
      stop_ = fmt::format("byte {} lies within the head of a record", file_.bytes());
      return {};
    }
    std::array<std::byte, kRecordHeadBytes> bytes{};
    if (::bleedsim::Status status = file_.read(at, bytes); !status) return status;
    const RecordHead head = parseRecordHead(bytes);
    // Blocks that the system had no time to write read as zeros.
    if (static_cast<std::uint8_t>(head.opcode) == 0) {
      stop_ = fmt::format("from byte {} on nothing was written", at);
      return {};
    }
    if (head.length > file_.bytes() - at - kRecordHeadBytes) {
      stop_ = fmt::format("the record at byte {} is not complete", at);
      return {};
    }
    if (head.opcode == Opcode::data_end || head.opcode == Opcode::footer) {
      stop_ = fmt::format("the data end at byte {}", at);
      return {};
    }
    if (::bleedsim::Status status = visit(head, at); !status) {
      if (damage_ == Damage::refuse || status.code() != StatusCode::data_loss) return status;
      stop_ = status.message();
      return {};
    }
    at += kRecordHeadBytes + head.length;
  }
  stop_ = fmt::format("the file ends at byte {}, between two records", at);
  return {};
}

template <class T>
::bleedsim::Status Scanner::load(const RecordHead& head, std::uint64_t offset, T& out) {
  std::vector<std::byte> content;
  if (::bleedsim::Status status = readRecord(file_, offset, head.opcode, kMaxRecordBytes, content); !status) return status;
  if (!parse(content, out)) {
    return damaged(offset, fmt::format("record 0x{:02x} is too short", static_cast<unsigned>(head.opcode)));
  }
  return {};
}

::bleedsim::Status Scanner::visit(const RecordHead& head, std::uint64_t offset) {
  switch (head.opcode) {
    case Opcode::schema: {
      Schema schema;
      if (::bleedsim::Status status = load(head, offset, schema); !status) return status;
      index_.schemas[schema.id] = std::move(schema);
      return {};
    }
    case Opcode::channel: {
      Channel channel;
      if (::bleedsim::Status status = load(head, offset, channel); !status) return status;
      index_.channels[channel.id] = std::move(channel);
      return {};
    }
    case Opcode::metadata: {
      Metadata metadata;
      if (::bleedsim::Status status = load(head, offset, metadata); !status) return status;
      index_.metadata[metadata.name] = std::move(metadata.entries);
      return {};
    }
    case Opcode::chunk:
      return visitChunk(head, offset);
    case Opcode::message_index:
      return visitMessageIndex(head, offset);
    case Opcode::message:
      return {StatusCode::unsupported,
              fmt::format("'{}' holds messages outside chunks, which recordings do not use", file_.name())};
    default:
      return {};
  }
}

::bleedsim::Status Scanner::visitChunk(const RecordHead& head, std::uint64_t offset) {
  std::array<std::byte, kChunkHeadRoom> room{};
  const std::span<std::byte> front{room.data(), static_cast<std::size_t>(std::min<std::uint64_t>(head.length, room.size()))};
  if (::bleedsim::Status status = file_.read(offset + kRecordHeadBytes, front); !status) return status;
  ChunkHead chunk;
  std::size_t head_bytes = 0;
  if (!parse(front, chunk, head_bytes) || chunk.compressed_bytes > head.length - head_bytes) {
    return damaged(offset, "a chunk is longer than its record");
  }
  if (chunk.uncompressed_bytes > kMaxChunkBytes || head.length > kMaxChunkBytes) {
    return damaged(offset, fmt::format("a chunk of {} bytes is larger than {} bytes, the most that is read",
                                       std::max(chunk.uncompressed_bytes, head.length), kMaxChunkBytes));
  }
  ChunkIndex entry;
  entry.first_time_ns = chunk.first_time_ns;
  entry.last_time_ns = chunk.last_time_ns;
  entry.offset = offset;
  entry.length = kRecordHeadBytes + head.length;
  entry.compression = std::move(chunk.compression);
  entry.compressed_bytes = chunk.compressed_bytes;
  entry.uncompressed_bytes = chunk.uncompressed_bytes;
  index_.chunks.push_back(std::move(entry));
  return {};
}

::bleedsim::Status Scanner::visitMessageIndex(const RecordHead& head, std::uint64_t offset) {
  MessageIndex index;
  if (::bleedsim::Status status = load(head, offset, index); !status) return status;
  if (!index_.chunks.empty()) {
    ChunkIndex& chunk = index_.chunks.back();
    chunk.message_index_offsets[index.channel_id] = offset;
    chunk.message_index_bytes += kRecordHeadBytes + head.length;
  }
  return {};
}

}  // namespace

Result<FileIndex> scanIndex(const FileSource& file, std::string reason, Damage damage) {
  Scanner scanner{file, damage};
  if (::bleedsim::Status status = scanner.run(); !status) return status;
  FileIndex index = scanner.take();
  index.truncated = true;
  index.truncation_reason = fmt::format("{}; {}", std::move(reason), scanner.stop());
  return index;
}

}  // namespace bleedsim::recording::mcap
