#include "service/replay/replay.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <set>
#include <tuple>

#include "service/build/build_info.h"
#include "service/replay/replay_session.h"

namespace bleedsim::replay {
namespace {

/// A place in an epoch: so many steps, and so many entries of its journal.
struct Place {
  std::uint64_t step = 0;
  std::uint64_t number = 0;

  bool operator<(const Place& other) const { return std::tie(step, number) < std::tie(other.step, other.number); }
};

/// Snapshots that later epochs go on from, by epoch and place.
using Snapshots = std::map<std::pair<std::uint32_t, Place>, std::optional<Snapshot>>;

bool isOfRun(const recording::Restored& restored, const RecordedRun& run) { return restored.session() == run.session; }

/// Epochs to be simulated: those with states to compare, and those that these go on from.
std::set<std::uint32_t> neededEpochs(const RecordedRun& run) {
  std::set<std::uint32_t> needed;
  for (auto epoch = run.epochs.rbegin(); epoch != run.epochs.rend(); ++epoch) {
    const auto& [number, recorded] = *epoch;
    if (!recorded.states.empty()) needed.insert(number);
    const recording::Restored* restored = recorded.restored();
    // A checkpoint is older than what goes on from it.
    if (needed.contains(number) && restored != nullptr && isOfRun(*restored, run) && restored->epoch() < number) {
      needed.insert(restored->epoch());
    }
  }
  return needed;
}

Snapshots wantedSnapshots(const RecordedRun& run, const std::set<std::uint32_t>& needed) {
  Snapshots wanted;
  for (const std::uint32_t number : needed) {
    const recording::Restored* restored = run.epochs.at(number).restored();
    if (restored == nullptr || !isOfRun(*restored, run)) continue;
    wanted[{restored->epoch(), {restored->step(), restored->number()}}] = std::nullopt;
  }
  return wanted;
}

/// One epoch on its way.
class EpochRun {
 public:
  EpochRun(const RecordedEpoch& recorded, ReplaySession session, EpochReplay& report)
      : recorded_{recorded}, session_{std::move(session)}, report_{report} {
    report.first_step = session_.world().stepCount();
    // What a restored state contains is the affair of its own epoch; the first entry only tells of it.
    if (recorded.restored() != nullptr) next_ = 1;
  }

  ReplaySession& session() { return session_; }

  /// False: report.broken says why that place cannot be reached.
  bool advanceTo(const Place& place) {
    while (session_.world().stepCount() < place.step) {
      if (!applyEntries({session_.world().stepCount(), std::numeric_limits<std::uint64_t>::max()}) || !step()) return false;
    }
    if (session_.world().stepCount() > place.step) return breakOff("a state lies before the one that it follows");
    return applyEntries(place);
  }

  /// A world that stopped on bad numbers shows the state in which it did, with as many steps as before.
  void stepIntoFault() { static_cast<void>(session_.world().step(std::numeric_limits<double>::infinity())); }

 private:
  bool step() {
    if (Status stepped = session_.world().step(std::numeric_limits<double>::infinity()); !stepped) {
      return breakOff("the solver stopped: " + stepped.message());
    }
    ++report_.steps;
    return true;
  }

  /// Those of the present step, up to that number.
  bool applyEntries(const Place& place) {
    for (; next_ < recorded_.journal.size(); ++next_) {
      const recording::Journal& entry = recorded_.journal[next_];
      if (entry.step() > place.step || entry.number() > place.number) return true;
      if (entry.step() < session_.world().stepCount()) {
        return breakOff(fmt::format("journal entry {} is of a step that is over", entry.number()));
      }
      if (Status applied = session_.apply(entry); !applied) {
        return breakOff(fmt::format("journal entry {} at step {}: {}", entry.number(), entry.step(), applied.message()));
      }
      ++report_.inputs;
    }
    return true;
  }

  bool breakOff(const std::string& why) {
    report_.broken = fmt::format("after step {}: {}", session_.world().stepCount(), why);
    return false;
  }

  const RecordedEpoch& recorded_;
  ReplaySession session_;
  EpochReplay& report_;
  std::size_t next_ = 0;
};

class Replayer {
 public:
  Replayer(const RecordedRun& run, const ReplayOptions& options, const sph::WorldOptions& world)
      : run_{run}, options_{options}, world_{world}, needed_{neededEpochs(run)}, snapshots_{wantedSnapshots(run, needed_)} {
    for (const std::uint32_t number : needed_) states_ += run.epochs.at(number).states.size();
  }

  Status replay(std::vector<EpochReplay>& reports) {
    for (const std::uint32_t number : needed_) {
      Result<ReplaySession> session = begin(number);
      if (!session) return {session.status().code(), fmt::format("epoch {}: {}", number, session.status().message())};
      EpochReplay report;
      report.epoch = number;
      follow(number, EpochRun{run_.epochs.at(number), std::move(*session), report}, report);
      reports.push_back(std::move(report));
    }
    return {};
  }

 private:
  Result<ReplaySession> begin(std::uint32_t number) {
    const RecordedEpoch& recorded = run_.epochs.at(number);
    const recording::Restored* restored = recorded.restored();
    if (restored == nullptr) {
      if (recorded.scene_text.empty()) return Status{StatusCode::not_found, "its scene is not in the file"};
      return ReplaySession::begin(recorded.scene_text, world_);
    }
    const auto snapshot = snapshots_.find({restored->epoch(), {restored->step(), restored->number()}});
    if (isOfRun(*restored, run_) && snapshot != snapshots_.end() && snapshot->second) {
      if (snapshot->second->hash != restored->state_hash()) {
        return Status{StatusCode::data_loss, fmt::format("it begins with checkpoint '{}' at step {} of epoch {}, whose state is "
                                                         "another one in this replay",
                                                         restored->name(), restored->step(), restored->epoch())};
      }
      return ReplaySession::goOn(*snapshot->second, world_);
    }
    if (options_.checkpoint) return goOnFromFile(*restored, *options_.checkpoint);
    return Status{
        StatusCode::not_found,
        fmt::format("it begins with checkpoint '{}' at step {} of {}, which is not in the file: give it with --checkpoint",
                    restored->name(), restored->step(),
                    isOfRun(*restored, run_) ? fmt::format("epoch {}", restored->epoch()) : "another session")};
  }

  Result<ReplaySession> goOnFromFile(const recording::Restored& restored, const checkpoint::Checkpoint& checkpoint) {
    if (checkpoint.head.mark.state_hash != restored.state_hash() || checkpoint.head.mark.step != restored.step()) {
      return Status{StatusCode::invalid_argument,
                    fmt::format("checkpoint '{}' of step {} is not the one that it begins with, '{}' of step {}",
                                checkpoint.head.name, checkpoint.head.mark.step, restored.name(), restored.step())};
    }
    return ReplaySession::goOn(checkpoint, world_);
  }

  void follow(std::uint32_t number, EpochRun run, EpochReplay& report) {
    const std::vector<RecordedState>& states = run_.epochs.at(number).states;
    auto snapshot = snapshots_.lower_bound({number, Place{}});
    const auto of_epoch = [&] { return snapshot != snapshots_.end() && snapshot->first.first == number; };
    std::optional<std::uint64_t> last_step;
    for (const RecordedState& state : states) {
      const Place place{state.step, state.journal_number};
      for (; of_epoch() && !(place < snapshot->first.second); ++snapshot) {
        if (!run.advanceTo(snapshot->first.second)) return;
        snapshot->second = run.session().snapshot();
      }
      if (!run.advanceTo(place)) return;
      compare(state, run, last_step == state.step, report);
      last_step = state.step;
      if (options_.progress) options_.progress(static_cast<double>(++states_seen_) / static_cast<double>(states_));
    }
    for (; of_epoch(); ++snapshot) {
      if (!run.advanceTo(snapshot->first.second)) return;
      snapshot->second = run.session().snapshot();
    }
  }

  /// `again`: the state before has as many steps.
  void compare(const RecordedState& state, EpochRun& run, bool again, EpochReplay& report) {
    if (state.step < options_.from_step) return;
    std::uint64_t hash = run.session().world().stateHash();
    if (again && hash != state.hash) {
      run.stepIntoFault();
      hash = run.session().world().stateHash();
    }
    ++report.compared;
    if (hash == state.hash) {
      ++report.equal;
    } else if (!report.difference) {
      report.difference = Difference{state, hash};
    }
    if (options_.seen) options_.seen(state);
  }

  const RecordedRun& run_;
  const ReplayOptions& options_;
  sph::WorldOptions world_;
  std::set<std::uint32_t> needed_;
  Snapshots snapshots_;
  std::size_t states_ = 0;
  std::size_t states_seen_ = 0;
};

/// Of the states that there are to compare.
std::uint64_t lastStep(const RecordedRun& run) {
  std::uint64_t last = 0;
  for (const auto& [number, epoch] : run.epochs) {
    for (const RecordedState& state : epoch.states) last = std::max(last, state.step);
  }
  return last;
}

/// What speaks against bit-equal states.
std::vector<std::string> doubts(const RecordedRun& run, sph::SimdTarget target) {
  std::vector<std::string> out;
  if (run.build_id != buildId()) out.push_back(fmt::format("it was made by build '{}', this is '{}'", run.build_id, buildId()));
  if (run.simd_target != sph::simdTargetName(target)) {
    out.push_back(
        fmt::format("it was made with SIMD target '{}', this replay uses '{}'", run.simd_target, sph::simdTargetName(target)));
  }
  if (!run.not_replayable.empty()) out.push_back(run.not_replayable);
  return out;
}

Result<sph::SimdTarget> chooseTarget(const RecordedRun& run, sph::SimdTarget wanted) {
  if (wanted != sph::SimdTarget::automatic) return wanted;
  const Result<sph::SimdTarget> recorded = sph::parseSimdTarget(run.simd_target);
  const std::vector<sph::SimdTarget> available = sph::availableSimdTargets();
  if (recorded && std::find(available.begin(), available.end(), *recorded) != available.end()) return *recorded;
  return available.front();
}

}  // namespace

bool ReplayReport::bitEqual() const {
  const bool compared = std::any_of(epochs.begin(), epochs.end(), [](const EpochReplay& epoch) { return epoch.compared > 0; });
  return compared && std::all_of(epochs.begin(), epochs.end(),
                                 [](const EpochReplay& epoch) { return epoch.broken.empty() && epoch.equal == epoch.compared; });
}

Result<ReplayReport> replayRun(const RecordedRun& run, const ReplayOptions& options) {
  if (neededEpochs(run).empty()) return Status{StatusCode::not_found, "it holds no statistics of frames to compare with"};
  const Result<sph::SimdTarget> target = chooseTarget(run, options.simd);
  if (!target) return target.status();
  if (run.precision != "float32" && run.precision != "float64") {
    return Status{StatusCode::unsupported,
                  fmt::format("its precision is '{}', this build has float32 and float64", run.precision)};
  }
  ReplayReport report;
  report.session_name = run.session_name;
  report.build_id = run.build_id;
  report.simd_target = sph::simdTargetName(*target);
  report.precision = run.precision;
  report.notes = doubts(run, *target);
  // Where an epoch goes on from a checkpoint that was given, the file alone need not be enough.
  if (options.verify && !report.notes.empty() && !(options.checkpoint && report.notes.front() == run.not_replayable)) {
    return Status{StatusCode::unsupported, report.notes.front()};
  }
  // Known before anything is simulated: a comparison of nothing would pass.
  if (const std::uint64_t last = lastStep(run); options.verify && last < options.from_step) {
    return Status{StatusCode::not_found,
                  fmt::format("it has no state from step {} on to compare; its last one is of step {}", options.from_step, last)};
  }
  sph::WorldOptions world;
  world.threads = options.threads;
  world.simd = *target;
  world.precision = run.precision == "float64" ? sph::Precision::float64 : sph::Precision::float32;
  if (Status followed = Replayer{run, options, world}.replay(report.epochs); !followed) return followed;
  return report;
}

}  // namespace bleedsim::replay
