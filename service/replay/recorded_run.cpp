#include "service/replay/recorded_run.h"

#include <algorithm>

#include "service/recording/recording_reader.h"
#include "service/recording/summary.h"

namespace bleedsim::replay {
namespace {

void addScene(const recording::Scene& scene, RecordedRun& run) {
  RecordedEpoch& epoch = run.epochs[scene.epoch()];
  epoch.scene_text = scene.loaded_text();
  epoch.seed = scene.seed();
  epoch.speed_of_sound = scene.speed_of_sound_m_per_s();
  run.session_name = scene.session_name();
  run.build_id = scene.build_id();
  run.simd_target = scene.simd_target();
  run.precision = scene.precision();
}

void addState(const recording::FrameStats& stats, RecordedRun& run) {
  run.epochs[stats.epoch()].states.push_back(
      {stats.seq(), stats.step(), stats.journal_number(), stats.sim_time_s(), stats.state_hash(), stats.particles()});
}

/// Topics come each in its own order, and a late reader may have got an entry twice.
void putInOrder(RecordedEpoch& epoch) {
  const auto number = [](const recording::Journal& entry) { return entry.number(); };
  std::stable_sort(epoch.journal.begin(), epoch.journal.end(),
                   [&](const auto& a, const auto& b) { return number(a) < number(b); });
  epoch.journal.erase(std::unique(epoch.journal.begin(), epoch.journal.end(),
                                  [&](const auto& a, const auto& b) { return number(a) == number(b); }),
                      epoch.journal.end());
  std::stable_sort(epoch.states.begin(), epoch.states.end(),
                   [](const RecordedState& a, const RecordedState& b) { return a.seq < b.seq; });
}

::bleedsim::Status readMessage(const recording::RecordedMessage& message, RecordedRun& run) {
  // A file with more than one session is not replayable: only the first one is looked at.
  const auto of_run = [&run](const std::string& session) {
    if (run.session.empty()) run.session = session;
    return session == run.session;
  };
  if (message.topic == recording::Topic::scene) {
    recording::Scene scene;
    if (::bleedsim::Status status = recording::decode(message, scene); !status) return status;
    if (of_run(scene.session())) addScene(scene, run);
  } else if (message.topic == recording::Topic::journal) {
    recording::Journal entry;
    if (::bleedsim::Status status = recording::decode(message, entry); !status) return status;
    if (of_run(entry.session())) run.epochs[entry.epoch()].journal.push_back(std::move(entry));
  } else if (message.topic == recording::Topic::frame_stats) {
    recording::FrameStats stats;
    if (::bleedsim::Status status = recording::decode(message, stats); !status) return status;
    if (of_run(stats.session())) addState(stats, run);
  }
  return {};
}

}  // namespace

Result<RecordedRun> readRun(const std::filesystem::path& path) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return reader.status();
  const Result<recording::RecordingSummary> summary = recording::summarize(*reader);
  if (!summary) return summary.status();
  RecordedRun run;
  run.not_replayable = summary->reason;
  run.truncated = summary->truncated ? summary->truncation_reason : "";
  reader->select({recording::Topic::scene, recording::Topic::journal, recording::Topic::frame_stats});
  recording::RecordedMessage message;
  for (;;) {
    const Result<bool> more = reader->next(message);
    if (!more) return more.status();
    if (!*more) break;
    if (::bleedsim::Status status = readMessage(message, run); !status) return status;
  }
  for (auto& [number, epoch] : run.epochs) putInOrder(epoch);
  return run;
}

}  // namespace bleedsim::replay
