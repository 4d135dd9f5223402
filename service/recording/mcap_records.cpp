#include "service/recording/mcap_records.h"

#include <algorithm>
#include <concepts>
#include <limits>
#include <zlib.h>

namespace bleedsim::recording::mcap {
namespace {

template <std::unsigned_integral T>
void put(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out += static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
}

void putString(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

/// Where a length stands that is known only once its content is written.
template <std::unsigned_integral T>
class LengthMark {
 public:
  explicit LengthMark(std::string& out) : out_{out}, at_{out.size()} { put(out, T{0}); }
  LengthMark(const LengthMark&) = delete;
  LengthMark& operator=(const LengthMark&) = delete;
  ~LengthMark() {
    const auto length = static_cast<T>(out_.size() - at_ - sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) out_[at_ + i] = static_cast<char>(static_cast<std::uint8_t>(length >> (8 * i)));
  }

 private:
  std::string& out_;
  std::size_t at_;
};

class RecordMark {
 public:
  RecordMark(std::string& out, Opcode opcode) : length_{begin(out, opcode)} {}

 private:
  static std::string& begin(std::string& out, Opcode opcode) {
    out += static_cast<char>(opcode);
    return out;
  }

  LengthMark<std::uint64_t> length_;
};

void putMap(std::string& out, const std::map<std::string, std::string>& entries) {
  const LengthMark<std::uint32_t> length{out};
  for (const auto& [key, value] : entries) {
    putString(out, key);
    putString(out, value);
  }
}

void putMap(std::string& out, const std::map<std::uint16_t, std::uint64_t>& entries) {
  const LengthMark<std::uint32_t> length{out};
  for (const auto& [key, value] : entries) {
    put(out, key);
    put(out, value);
  }
}

/// Reads on as long as everything fits; afterwards ok() tells whether it did.
class Cursor {
 public:
  explicit Cursor(ByteView bytes) : bytes_{bytes} {}

  bool ok() const { return ok_; }
  std::size_t position() const { return at_; }
  bool atEnd() const { return at_ == bytes_.size(); }

  template <std::unsigned_integral T>
  T get() {
    T value = 0;
    const ByteView field = take(sizeof(T));
    for (std::size_t i = 0; i < field.size(); ++i)
      value = static_cast<T>(value | static_cast<T>(static_cast<T>(field[i]) << (8 * i)));
    return value;
  }

  template <std::unsigned_integral T>
  void get(T& out) {
    out = get<T>();
  }

  void get(std::string& out) {
    const ByteView field = take(get<std::uint32_t>());
    out.assign(field.size(), '\0');
    std::transform(field.begin(), field.end(), out.begin(), [](std::byte b) { return static_cast<char>(b); });
  }

  ByteView take(std::uint64_t count) {
    if (!ok_ || count > bytes_.size() - at_) {
      ok_ = false;
      return {};
    }
    const ByteView field = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += field.size();
    return field;
  }

  void get(std::map<std::string, std::string>& out) {
    Cursor inner{take(get<std::uint32_t>())};
    while (inner.ok_ && !inner.atEnd()) {
      std::string key;
      inner.get(key);
      inner.get(out[key]);
    }
    ok_ = ok_ && inner.ok_;
  }

  void get(std::map<std::uint16_t, std::uint64_t>& out) {
    Cursor inner{take(get<std::uint32_t>())};
    while (inner.ok_ && !inner.atEnd()) {
      const auto key = inner.get<std::uint16_t>();
      out[key] = inner.get<std::uint64_t>();
    }
    ok_ = ok_ && inner.ok_;
  }

 private:
  ByteView bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace

void appendHeader(std::string& out, std::string_view profile, std::string_view library) {
  const RecordMark mark{out, Opcode::header};
  putString(out, profile);
  putString(out, library);
}

void appendRecord(std::string& out, const Schema& record) {
  const RecordMark mark{out, Opcode::schema};
  put(out, record.id);
  putString(out, record.name);
  putString(out, record.encoding);
  putString(out, record.data);
}

void appendRecord(std::string& out, const Channel& record) {
  const RecordMark mark{out, Opcode::channel};
  put(out, record.id);
  put(out, record.schema_id);
  putString(out, record.topic);
  putString(out, record.message_encoding);
  putMap(out, record.metadata);
}

void appendRecord(std::string& out, const MessageHead& record, std::string_view data) {
  const RecordMark mark{out, Opcode::message};
  put(out, record.channel_id);
  put(out, record.sequence);
  put(out, record.log_time_ns);
  put(out, record.publish_time_ns);
  out += data;
}

void appendRecord(std::string& out, const ChunkHead& record, std::string_view compressed) {
  const RecordMark mark{out, Opcode::chunk};
  put(out, record.first_time_ns);
  put(out, record.last_time_ns);
  put(out, record.uncompressed_bytes);
  put(out, record.uncompressed_crc);
  putString(out, record.compression);
  put(out, std::uint64_t{compressed.size()});
  out += compressed;
}

void appendRecord(std::string& out, const MessageIndex& record) {
  const RecordMark mark{out, Opcode::message_index};
  put(out, record.channel_id);
  const LengthMark<std::uint32_t> length{out};
  for (const auto& [time, offset] : record.entries) {
    put(out, time);
    put(out, offset);
  }
}

void appendRecord(std::string& out, const ChunkIndex& record) {
  const RecordMark mark{out, Opcode::chunk_index};
  put(out, record.first_time_ns);
  put(out, record.last_time_ns);
  put(out, record.offset);
  put(out, record.length);
  putMap(out, record.message_index_offsets);
  put(out, record.message_index_bytes);
  putString(out, record.compression);
  put(out, record.compressed_bytes);
  put(out, record.uncompressed_bytes);
}

void appendRecord(std::string& out, const Statistics& record) {
  const RecordMark mark{out, Opcode::statistics};
  put(out, record.messages);
  put(out, record.schemas);
  put(out, record.channels);
  put(out, record.attachments);
  put(out, record.metadata);
  put(out, record.chunks);
  put(out, record.first_time_ns);
  put(out, record.last_time_ns);
  putMap(out, record.channel_messages);
}

void appendRecord(std::string& out, const Metadata& record) {
  const RecordMark mark{out, Opcode::metadata};
  putString(out, record.name);
  putMap(out, record.entries);
}

void appendRecord(std::string& out, const MetadataIndex& record) {
  const RecordMark mark{out, Opcode::metadata_index};
  put(out, record.offset);
  put(out, record.length);
  putString(out, record.name);
}

void appendSummaryOffset(std::string& out, Opcode group, std::uint64_t start, std::uint64_t length) {
  const RecordMark mark{out, Opcode::summary_offset};
  put(out, static_cast<std::uint8_t>(group));
  put(out, start);
  put(out, length);
}

void appendDataEnd(std::string& out, std::uint32_t data_crc) {
  const RecordMark mark{out, Opcode::data_end};
  put(out, data_crc);
}

void appendFooter(std::string& out, std::uint64_t summary_start, std::uint64_t summary_offset_start, std::uint32_t summary_crc) {
  const std::size_t at = out.size();
  const RecordMark mark{out, Opcode::footer};
  put(out, summary_start);
  put(out, summary_offset_start);
  // The checksum covers the length too, which the mark would write only at the end.
  std::string head;
  head += static_cast<char>(Opcode::footer);
  put(head, std::uint64_t{kFooterBytes});
  const std::uint32_t crc =
      crc32(crc32(summary_crc, bytesOf(head)), bytesOf(std::string_view{out}.substr(at + kRecordHeadBytes)));
  put(out, crc);
}

bool parse(ByteView content, Schema& out) {
  Cursor in{content};
  in.get(out.id);
  in.get(out.name);
  in.get(out.encoding);
  in.get(out.data);
  return in.ok();
}

bool parse(ByteView content, Channel& out) {
  Cursor in{content};
  in.get(out.id);
  in.get(out.schema_id);
  in.get(out.topic);
  in.get(out.message_encoding);
  in.get(out.metadata);
  return in.ok();
}

bool parse(ByteView content, MessageHead& out) {
  Cursor in{content};
  in.get(out.channel_id);
  in.get(out.sequence);
  in.get(out.log_time_ns);
  in.get(out.publish_time_ns);
  return in.ok();
}

bool parse(ByteView content, ChunkHead& out, std::size_t& head_bytes) {
  Cursor in{content};
  in.get(out.first_time_ns);
  in.get(out.last_time_ns);
  in.get(out.uncompressed_bytes);
  in.get(out.uncompressed_crc);
  in.get(out.compression);
  in.get(out.compressed_bytes);
  head_bytes = in.position();
  return in.ok();
}

bool parse(ByteView content, MessageIndex& out) {
  Cursor in{content};
  in.get(out.channel_id);
  const ByteView entries = in.take(in.get<std::uint32_t>());
  if (!in.ok() || entries.size() % kIndexEntryBytes != 0) return false;
  Cursor list{entries};
  out.entries.clear();
  out.entries.reserve(entries.size() / kIndexEntryBytes);
  while (!list.atEnd()) {
    const auto time = list.get<std::uint64_t>();
    out.entries.emplace_back(time, list.get<std::uint64_t>());
  }
  return true;
}

bool parse(ByteView content, ChunkIndex& out) {
  Cursor in{content};
  in.get(out.first_time_ns);
  in.get(out.last_time_ns);
  in.get(out.offset);
  in.get(out.length);
  in.get(out.message_index_offsets);
  in.get(out.message_index_bytes);
  in.get(out.compression);
  in.get(out.compressed_bytes);
  in.get(out.uncompressed_bytes);
  return in.ok();
}

bool parse(ByteView content, Metadata& out) {
  Cursor in{content};
  in.get(out.name);
  in.get(out.entries);
  return in.ok();
}

bool parse(ByteView content, MetadataIndex& out) {
  Cursor in{content};
  in.get(out.offset);
  in.get(out.length);
  in.get(out.name);
  return in.ok();
}

bool parse(ByteView content, Footer& out) {
  Cursor in{content};
  in.get(out.summary_start);
  in.get(out.summary_offset_start);
  in.get(out.summary_crc);
  return in.ok();
}

RecordHead parseRecordHead(ByteView bytes) {
  Cursor in{bytes};
  RecordHead head;
  head.opcode = static_cast<Opcode>(in.get<std::uint8_t>());
  head.length = in.get<std::uint64_t>();
  return head;
}

std::uint32_t crc32(std::uint32_t crc, ByteView bytes) {
  uLong running = crc;
  while (!bytes.empty()) {
    const std::size_t part = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
    running = ::crc32(running, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(part));
    bytes = bytes.subspan(part);
  }
  return static_cast<std::uint32_t>(running);
}

}  // namespace bleedsim::recording::mcap
