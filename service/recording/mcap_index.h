// Where everything stands in an MCAP file: taken from the summary, or, when that is missing, from a walk over the records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "service/recording/file_source.h"
#include "service/recording/mcap_records.h"
#include "service/status/status.h"

namespace bleedsim::recording::mcap {

/// Largest chunk, compressed or not: a damaged or hostile length must not take the machine's memory.
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{320} << 20;
/// Largest schema, channel, metadata or message index record, and largest summary.
inline constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{64} << 20;

struct FileIndex {
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::uint64_t summary_start = 0;  ///< 0: no summary
  bool truncated = false;
  std::string truncation_reason;
};

enum class Damage {
  refuse,    ///< a damaged index or record is an error
  tolerate,  ///< a damaged index is replaced by a scan, which ends at a damaged record: the file counts as cut off there
};

/// Reads the summary of a complete file, or scans one that was cut off. data_loss: damaged, or no MCAP file.
Result<FileIndex> readIndex(const FileSource& file, Damage damage = Damage::refuse);

/// The head at `offset` and the content of a record of that kind, at most `limit` bytes.
::bleedsim::Status readRecord(const FileSource& file, std::uint64_t offset, Opcode opcode, std::uint64_t limit,
                              std::vector<std::byte>& content);

/// Walks over the file's records; used by readIndex() when there is no summary.
Result<FileIndex> scanIndex(const FileSource& file, std::string reason, Damage damage);

}  // namespace bleedsim::recording::mcap
