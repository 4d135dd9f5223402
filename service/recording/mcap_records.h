// The records of an MCAP file, as values, and their little-endian codec. https://mcap.dev/spec (format version 0, magic "MCAP0").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bleedsim::recording::mcap {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::size_t kRecordHeadBytes = 9;    ///< opcode and length
inline constexpr std::size_t kFooterBytes = 20;       ///< without the record's head
inline constexpr std::size_t kMessageHeadBytes = 22;  ///< of a message's content, before its data
inline constexpr std::size_t kIndexEntryBytes = 16;   ///< time and offset

using ByteView = std::span<const std::byte>;

struct Schema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;
  std::map<std::string, std::string> metadata;
};

struct MessageHead {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
};

/// What precedes the compressed records in a chunk.
struct ChunkHead {
  std::uint64_t first_time_ns = 0;
  std::uint64_t last_time_ns = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t uncompressed_crc = 0;
  std::string compression;
  std::uint64_t compressed_bytes = 0;
};

struct MessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;  ///< log time, offset in the uncompressed chunk
};

struct ChunkIndex {
  std::uint64_t first_time_ns = 0;
  std::uint64_t last_time_ns = 0;
  std::uint64_t offset = 0;  ///< of the chunk record in the file
  std::uint64_t length = 0;  ///< of the chunk record with its head
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;
  std::uint64_t message_index_bytes = 0;
  std::string compression;
  std::uint64_t compressed_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t first_time_ns = 0;
  std::uint64_t last_time_ns = 0;
  std::map<std::uint16_t, std::uint64_t> channel_messages;
};

struct Metadata {
  std::string name;
  std::map<std::string, std::string> entries;
};

struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
};

struct Footer {
  std::uint64_t summary_start = 0;
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};

/// Each appends one whole record, head included.
void appendHeader(std::string& out, std::string_view profile, std::string_view library);
void appendRecord(std::string& out, const Schema& record);
void appendRecord(std::string& out, const Channel& record);
void appendRecord(std::string& out, const MessageHead& record, std::string_view data);
void appendRecord(std::string& out, const ChunkHead& record, std::string_view compressed);
void appendRecord(std::string& out, const MessageIndex& record);
void appendRecord(std::string& out, const ChunkIndex& record);
void appendRecord(std::string& out, const Statistics& record);
void appendRecord(std::string& out, const Metadata& record);
void appendRecord(std::string& out, const MetadataIndex& record);
void appendSummaryOffset(std::string& out, Opcode group, std::uint64_t start, std::uint64_t length);
void appendDataEnd(std::string& out, std::uint32_t data_crc);
/// The footer's CRC covers the summary section and the footer's own first bytes: `summary_crc` is that of the section.
void appendFooter(std::string& out, std::uint64_t summary_start, std::uint64_t summary_offset_start, std::uint32_t summary_crc);

/// Each reads a record's content (without head); false when it does not fit its length. Bytes after the known members are
/// allowed, as the format asks.
bool parse(ByteView content, Schema& out);
bool parse(ByteView content, Channel& out);
bool parse(ByteView content, MessageHead& out);
/// The compressed records are the `compressed_bytes` after `head_bytes`; they need not be in `content`.
bool parse(ByteView content, ChunkHead& out, std::size_t& head_bytes);
bool parse(ByteView content, MessageIndex& out);
bool parse(ByteView content, ChunkIndex& out);
bool parse(ByteView content, Metadata& out);
bool parse(ByteView content, MetadataIndex& out);
bool parse(ByteView content, Footer& out);

struct RecordHead {
  Opcode opcode = Opcode::header;
  std::uint64_t length = 0;
};
/// Needs kRecordHeadBytes bytes.
RecordHead parseRecordHead(ByteView bytes);

/// CRC-32 as zlib has it, going on from `crc` (0 at the start).
std::uint32_t crc32(std::uint32_t crc, ByteView bytes);

inline ByteView bytesOf(std::string_view text) { return std::as_bytes(std::span{text}); }

}  // namespace bleedsim::recording::mcap
