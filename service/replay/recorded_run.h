// What a recording tells of a run: the scenes it began with, its inputs, and what its states were.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::replay {

/// A state that the recording tells of.
struct RecordedState {
  std::uint64_t seq = 0;
  std::uint64_t step = 0;
  std::uint64_t journal_number = 0;  ///< entries of the journal that it contains
  double sim_time = 0.0;             ///< s
  std::uint64_t hash = 0;
  std::uint32_t particles = 0;
};

struct RecordedEpoch {
  std::string scene_text;  ///< that it began with; empty: not in the file
  std::uint64_t seed = 0;
  double speed_of_sound = 0.0;              ///< m/s
  std::vector<recording::Journal> journal;  ///< by rising number, each once
  std::vector<RecordedState> states;        ///< by rising seq

  /// The state that it goes on from; null if it begins with its scene.
  const recording::Restored* restored() const {
    return !journal.empty() && journal.front().has_restored() ? &journal.front().restored() : nullptr;
  }
};

struct RecordedRun {
  std::string session;  ///< 16 bytes
  std::string session_name;
  std::string build_id;
  std::string simd_target;
  std::string precision;
  std::map<std::uint32_t, RecordedEpoch> epochs;
  std::string not_replayable;  ///< why not, as bleedctl info tells it; empty: it is whole enough
  std::string truncated;       ///< where reading ended early; empty: it did not
};

/// Errors as recording::RecordingReader::open and next.
Result<RecordedRun> readRun(const std::filesystem::path& path);

}  // namespace bleedsim::replay
