// Simulates a recorded run again from its scenes and journal, and compares the states.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/checkpoint/checkpoint.h"
#include "service/replay/recorded_run.h"
#include "service/sph/simd_target.h"
#include "service/status/status.h"

namespace bleedsim::replay {

struct ReplayOptions {
  int threads = 1;
  sph::SimdTarget simd = sph::SimdTarget::automatic;  ///< automatic: that of the recording
  /// Refuses where bit-equal states are not promised: another build or target, a journal with a gap.
  bool verify = false;
  std::uint64_t from_step = 0;                             ///< of each epoch: states before it are not compared
  std::optional<checkpoint::Checkpoint> checkpoint{};      ///< for an epoch that begins with one that is not in the file
  std::function<void(const RecordedState& state)> seen{};  ///< called for each state that was compared; may wait
  std::function<void(double part)> progress{};             ///< 0 to 1
};

/// The first state of an epoch that is another one.
struct Difference {
  RecordedState recorded;
  std::uint64_t replayed_hash = 0;
};

struct EpochReplay {
  std::uint32_t epoch = 0;
  std::uint64_t first_step = 0;
  std::uint64_t steps = 0;     ///< that were simulated
  std::uint64_t inputs = 0;    ///< journal entries that were applied
  std::uint64_t compared = 0;  ///< states
  std::uint64_t equal = 0;     ///< of these
  std::optional<Difference> difference;
  std::string broken;  ///< why it could not be followed to its end; empty: it could
};

struct ReplayReport {
  std::string session_name;
  std::string build_id;
  std::string simd_target;  ///< that was used
  std::string precision;
  std::vector<std::string> notes;  ///< what speaks against bit-equal states
  std::vector<EpochReplay> epochs;

  /// Some states were compared, and all of them are.
  bool bitEqual() const;
};

/// unsupported: bit-equal states are not promised, with the reason (verify only); data_loss, not_found: the scene of an epoch or
/// a checkpoint is missing or another one; not_found: there is no state to compare, from from_step on (verify only) or at all;
/// else as sph::createWorld.
Result<ReplayReport> replayRun(const RecordedRun& run, const ReplayOptions& options);

}  // namespace bleedsim::replay
