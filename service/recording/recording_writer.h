// Writes one recording: an MCAP file of the samples that a client received, with what was lost between them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "idl/bleed.h"
#include "service/recording/compression.h"
#include "service/status/status.h"

namespace bleedsim::recording {

struct WriterOptions {
  Compression compression = Compression::zstd;
  int zstd_level = 1;                              ///< 1 to 19
  std::size_t chunk_bytes = std::size_t{1} << 20;  ///< uncompressed size at which a chunk is written, 1 KiB to 64 MiB
  /// After which a chunk is written, so that a crash costs little: with tick() each 100 ms, less than a second.
  std::chrono::milliseconds chunk_age{800};
  std::size_t queue_bytes = std::size_t{64} << 20;  ///< that may wait for the disk, 64 KiB to 4 GiB
  bool quantize16 = false;                          ///< frames as quantize16() makes them; noted in the file
  bool point_cloud = false;                         ///< each frame as a foxglove.PointCloud as well, unquantised
  std::map<std::string, std::string> notes;         ///< metadata "bleedsim.notes" at the file's start; at most 64 entries
};

/// What a writer has taken so far.
struct WriterCounts {
  std::uint64_t frames = 0;
  std::uint64_t gaps = 0;     ///< frames missing between recorded ones or at the end, by their seq
  std::uint64_t skipped = 0;  ///< frames left out by choice, see skip()
  std::uint64_t frame_stats = 0;
  std::uint64_t statuses = 0;
  std::uint64_t scenes = 0;
  std::uint64_t journal_entries = 0;
  std::uint64_t journal_gaps = 0;  ///< journal numbers missing, from 1 in each epoch
  std::uint64_t refused = 0;       ///< samples that cannot be stored, see append()
  std::uint64_t bytes = 0;         ///< given to the disk so far
};

/// Not thread-safe. The disk is written by a thread of its own: only open() and close() wait for it. Holds one chunk and what
/// waits for the disk in memory, plus its index: 77 bytes for each chunk written and 10 for each topic in it.
class RecordingWriter {
 public:
  /// Creates or replaces the file. Errors: io when it cannot be created or written, invalid_argument for the options.
  static Result<RecordingWriter> open(const std::filesystem::path& path, const WriterOptions& options = {});

  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  /// Closes the file; call close() to learn whether that worked.
  ~RecordingWriter();

  /// Stores a sample. `log_time_ns` is CLOCK_REALTIME of the arrival; times that run backwards are raised to the one before.
  /// invalid_argument or unsupported: the sample contradicts itself (a length without data, text that is not UTF-8, an unknown
  /// union case, blocks that do not fit the payload where they are quantised or drawn); it is left out and counted, the recording
  /// goes on. io: the disk failed (full, quota, ...) or is so slow that `queue_bytes` wait for it; every later call gives the
  /// same answer, and what was written until then stays readable.
  ::bleedsim::Status append(const bleed_v1_Frame& sample, std::uint64_t log_time_ns = now());
  ::bleedsim::Status append(const bleed_v1_FrameStats& sample, std::uint64_t log_time_ns = now());
  ::bleedsim::Status append(const bleed_v1_Status& sample, std::uint64_t log_time_ns = now());
  ::bleedsim::Status append(const bleed_v1_Scene& sample, std::uint64_t log_time_ns = now());
  ::bleedsim::Status append(const bleed_v1_Journal& sample, std::uint64_t log_time_ns = now());

  /// To be called from time to time, so that samples reach the file though no others follow them. io: as append().
  ::bleedsim::Status tick(std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now());

  /// A frame that arrived and is left out by choice (a lower recording rate): its seq is no gap.
  void skip(const bleed_v1_Frame& sample);
  /// The session of the last frame had published frames up to this one: those that came no more are gaps.
  void publishedUntil(std::uint64_t seq);

  /// Writes the last chunk, the gaps and the index, and closes the file. Further calls give the first answer.
  ::bleedsim::Status close();

  const WriterCounts& counts() const;

  /// CLOCK_REALTIME in nanoseconds.
  static std::uint64_t now();

 private:
  struct Impl;
  explicit RecordingWriter(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::recording
