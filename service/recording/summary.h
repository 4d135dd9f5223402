// What a recording holds, in a few figures.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "service/recording/recording_reader.h"

namespace bleedsim::recording {

struct RecordingSummary {
  std::uint64_t frames = 0;
  std::uint64_t gaps = 0;     ///< published frames, between the recorded ones or at the end, that are missing
  std::uint64_t skipped = 0;  ///< frames left out by choice; of a rated recording that was cut off, all that are not there
  std::uint64_t frame_stats = 0;
  std::uint64_t statuses = 0;
  std::uint64_t scenes = 0;
  std::uint64_t journal_entries = 0;
  std::uint64_t journal_gaps = 0;
  std::uint32_t first_particles = 0;
  std::uint32_t last_particles = 0;
  std::uint32_t max_particles = 0;
  std::uint32_t epochs = 0;            ///< epochs with frames
  double duration_s = 0.0;             ///< simulated, from the first frame of each epoch to its last, summed
  double wall_duration_s = 0.0;        ///< between the arrival of the first and the last frame
  bool has_ledger = false;             ///< statistics of recorded frames are there; without them the volumes are 0
  double ml_emitted = 0.0;             ///< bled between the first and the last frame, summed over epochs
  double ml_emitted_total = 0.0;       ///< bled since the scene was loaded, at the last frame
  double mean_real_time_factor = 0.0;  ///< as the statistics say, mean over frames
  double max_behind_s = 0.0;           ///< most wall time that the pacing owed at a frame
  bool replayable = false;             ///< the scene is there, and the journal from number 1 without a gap in each recorded epoch
  std::string reason;                  ///< why it is not replayable; empty when it is
  bool truncated = false;              ///< the file was cut off; figures are of what could be read
  std::string truncation_reason;
  std::string session_name;
  std::string scene_name;
  std::string version;   ///< of the daemon
  std::string build_id;  ///< of the daemon
  std::string simd_target;
  std::string precision;
  std::string compression;  ///< of the chunks: none, lz4 or zstd; empty when there are none
  std::uint64_t file_bytes = 0;
  /// Largest errors of 16-bit attributes, by name, in their units; empty: every value is as it was published.
  std::map<std::string, double> max_errors;
  /// Of the last statistics: the solver's since its epoch began, the service's since its start.
  std::vector<std::pair<std::string, std::uint64_t>> fault_counters;
  /// First and last seq of each run of missing frames, the first 1000 of them; empty where frames were skipped.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> gap_ranges;
};

/// Reads the whole file once; the reader is rewound and selects every topic afterwards. Errors: as next(), data_loss for
/// messages that do not parse.
Result<RecordingSummary> summarize(RecordingReader& reader);

}  // namespace bleedsim::recording
