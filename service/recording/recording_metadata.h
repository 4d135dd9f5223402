// The metadata records of a recording: what a file holds, in figures, and what its messages cannot show.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "service/recording/mcap_records.h"

namespace bleedsim::recording {

inline constexpr const char* kRecordingMetadata = "bleedsim.recording";
/// What is known when a recording begins, and therefore in one that was cut off too.
inline constexpr const char* kNotesMetadata = "bleedsim.notes";
/// A note: at most so many frames per simulated second were to be recorded.
inline constexpr const char* kRateNote = "rate_hz";
/// A note: frames hold numbers of so many bits.
inline constexpr const char* kQuantizeNote = "quantize_bits";

struct RecordingFigures {
  std::uint64_t frames = 0;
  std::uint64_t gaps = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> gap_ranges;
  std::uint64_t published_until = 0;  ///< last frame that was published, when it is later than the last recorded one; else 0
  std::uint64_t skipped = 0;          ///< left out by choice
  std::uint64_t refused = 0;          ///< samples that could not be stored
  std::uint64_t journal_entries = 0;
  std::uint64_t journal_gaps = 0;
  std::string not_replayable;                  ///< why; empty when it is
  std::map<std::string, double> max_errors{};  ///< of quantised attributes, by name, in their units
  std::map<std::string, std::string> origin;   ///< session_name, scene_name, version, build_id, simd_target, precision
};

mcap::Metadata toMetadata(const RecordingFigures& figures);

/// What the messages of a file cannot show.
struct WriterKnowledge {
  std::uint64_t published_until = 0;
  std::uint64_t skipped = 0;
  std::uint64_t refused = 0;
  std::uint64_t gaps = 0;
  std::string not_replayable;
  /// The file was cut off, and frames were left out by choice: which missing ones were, nobody knows.
  bool thinned = false;
};
/// From all metadata of a file, by name. Malformed entries read as 0.
WriterKnowledge readKnowledge(const std::map<std::string, std::map<std::string, std::string>>& metadata);

}  // namespace bleedsim::recording
