// A checkpoint as a file:
//   16 bytes  "bleedsim state\n" and the version of the format, one byte
//   4 + 8     sizes of head and world, little-endian
//   4 + 4     CRC-32 of head and world
//   4         CRC-32 of the 36 bytes before
//   head      bleedsim.saved.Head of idl/checkpoint.proto
//   world     sph::World::saveState
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "service/checkpoint/checkpoint.h"
#include "service/status/status.h"

namespace bleedsim::checkpoint {

inline constexpr std::uint8_t kFormatVersion = 1;
/// Two scenes' texts and what belongs to them.
inline constexpr std::size_t kMaxHeadBytes = std::size_t{8} << 20;

/// io: the file cannot be written; the checkpoint of that name that was there stays.
Status writeCheckpoint(const std::filesystem::path& path, const Head& head, std::span<const std::byte> state);

/// data_loss: what is damaged; unsupported: a format of another version; not_found, io. No message names the file.
Result<Checkpoint> readCheckpoint(const std::filesystem::path& path);
/// Without the world and its checksum, for lists.
Result<Head> readHead(const std::filesystem::path& path);

/// readCheckpoint() of bytes.
Result<Checkpoint> decodeCheckpoint(std::span<const std::byte> file);
std::string encodeCheckpoint(const Head& head, std::span<const std::byte> state);

}  // namespace bleedsim::checkpoint
