#include "service/recording/summary.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "service/recording/seq_tracker.h"

namespace bleedsim::recording {
namespace {

using Epoch = std::pair<SessionKey, std::uint32_t>;

struct FrameSpan {
  std::uint64_t first_seq = 0;
  std::uint64_t last_seq = 0;
  double first_s = 0.0;
  double last_s = 0.0;
};

struct LedgerPoint {
  std::uint64_t seq = 0;
  double emitted_ml = 0.0;
};

class Collector {
 public:
  ::bleedsim::Status add(const RecordedMessage& message);
  RecordingSummary finish(const RecordingReader& reader);

 private:
  ::bleedsim::Status addFrame(const RecordedMessage& message);
  ::bleedsim::Status addStats(const RecordedMessage& message);
  ::bleedsim::Status addScene(const RecordedMessage& message);
  ::bleedsim::Status addJournal(const RecordedMessage& message);
  void addLedgers();
  void applyMetadata(const RecordingReader& reader);

  RecordingSummary out_;
  FrameTracker frames_;
  ReplayCheck replay_;
  std::map<Epoch, FrameSpan> spans_;
  std::vector<std::pair<Epoch, LedgerPoint>> ledger_;
  Epoch last_epoch_;
  double real_time_factors_ = 0.0;
  std::uint64_t first_time_ns_ = 0;
  std::uint64_t last_time_ns_ = 0;
  Frame frame_;
  FrameStats stats_;
};

::bleedsim::Status Collector::add(const RecordedMessage& message) {
  switch (message.topic) {
    case Topic::frame:
      return addFrame(message);
    case Topic::frame_stats:
      return addStats(message);
    case Topic::scene:
      return addScene(message);
    case Topic::journal:
      return addJournal(message);
    case Topic::status:
      ++out_.statuses;
      return {};
  }
  return {};
}

::bleedsim::Status Collector::addFrame(const RecordedMessage& message) {
  if (::bleedsim::Status status = decode(message, frame_); !status) return status;
  const Epoch epoch{frame_.session(), frame_.epoch()};
  if (out_.frames == 0) {
    out_.first_particles = frame_.count();
    first_time_ns_ = message.log_time_ns;
  }
  ++out_.frames;
  out_.last_particles = frame_.count();
  out_.max_particles = std::max(out_.max_particles, frame_.count());
  last_time_ns_ = message.log_time_ns;
  last_epoch_ = epoch;
  frames_.add(epoch.first, epoch.second, frame_.seq());
  replay_.addFrame(epoch.first, epoch.second);
  const auto [span, fresh] =
      spans_.try_emplace(epoch, FrameSpan{frame_.seq(), frame_.seq(), frame_.sim_time_s(), frame_.sim_time_s()});
  if (!fresh) {
    span->second.last_seq = frame_.seq();
    span->second.last_s = frame_.sim_time_s();
  }
  return {};
}

::bleedsim::Status Collector::addStats(const RecordedMessage& message) {
  if (::bleedsim::Status status = decode(message, stats_); !status) return status;
  ++out_.frame_stats;
  out_.fault_counters.clear();
  for (const Counter& counter : stats_.fault_counters()) out_.fault_counters.emplace_back(counter.name(), counter.value());
  real_time_factors_ += stats_.real_time_factor();
  out_.max_behind_s = std::max(out_.max_behind_s, stats_.behind_s());
  ledger_.push_back({Epoch{stats_.session(), stats_.epoch()}, {stats_.seq(), stats_.emitted_ml()}});
  return {};
}

::bleedsim::Status Collector::addScene(const RecordedMessage& message) {
  Scene scene;
  if (::bleedsim::Status status = decode(message, scene); !status) return status;
  if (out_.scenes == 0) {
    out_.session_name = scene.session_name();
    out_.scene_name = scene.scene_name();
    out_.version = scene.version();
    out_.build_id = scene.build_id();
    out_.simd_target = scene.simd_target();
    out_.precision = scene.precision();
  }
  ++out_.scenes;
  replay_.addScene(scene.session(), scene.epoch());
  return {};
}

::bleedsim::Status Collector::addJournal(const RecordedMessage& message) {
  Journal journal;
  if (::bleedsim::Status status = decode(message, journal); !status) return status;
  ++out_.journal_entries;
  replay_.addJournal(journal.session(), journal.epoch(), journal.number());
  return {};
}

void Collector::addLedgers() {
  struct Ends {
    LedgerPoint first;
    LedgerPoint last;
  };
  std::map<Epoch, Ends> ends;
  for (const auto& [epoch, point] : ledger_) {
    const auto span = spans_.find(epoch);
    if (span == spans_.end() || point.seq < span->second.first_seq || point.seq > span->second.last_seq) continue;
    const auto [entry, fresh] = ends.try_emplace(epoch, Ends{point, point});
    if (fresh) continue;
    if (point.seq < entry->second.first.seq) entry->second.first = point;
    if (point.seq > entry->second.last.seq) entry->second.last = point;
  }
  for (const auto& [epoch, pair] : ends) {
    out_.has_ledger = true;
    out_.ml_emitted += pair.last.emitted_ml - pair.first.emitted_ml;
    if (epoch == last_epoch_) out_.ml_emitted_total = pair.last.emitted_ml;
  }
}

// What the messages cannot show: frames left out by choice, lost ones at the end, and journal entries that could not be stored.
void Collector::applyMetadata(const RecordingReader& reader) {
  const auto record = reader.metadata().find("bleedsim.recording");
  if (record == reader.metadata().end()) return;
  const auto number = [&](const char* key, std::uint64_t& out) {
    const auto entry = record->second.find(key);
    if (entry == record->second.end() || entry->second.empty() || entry->second.size() > 19) return;
    std::uint64_t value = 0;
    for (const char digit : entry->second) {
      if (digit < '0' || digit > '9') return;
      value = value * 10 + static_cast<std::uint64_t>(digit - '0');
    }
    out = value;
  };
  std::uint64_t published_until = 0;
  number("published_until", published_until);
  frames_.publishedUntil(last_epoch_.first, published_until);
  out_.gaps = frames_.missing();
  out_.gap_ranges = frames_.ranges();
  number("skipped", out_.skipped);
  if (out_.skipped > 0) {
    number("gaps", out_.gaps);
    out_.gap_ranges.clear();
  }
  const auto replayable = record->second.find("replayable");
  const auto reason = record->second.find("reason");
  if (out_.replayable && replayable != record->second.end() && replayable->second == "false") {
    out_.replayable = false;
    out_.reason = reason == record->second.end() ? "the writer says so" : reason->second;
  }
}

RecordingSummary Collector::finish(const RecordingReader& reader) {
  out_.gaps = frames_.missing();
  out_.gap_ranges = frames_.ranges();
  out_.journal_gaps = replay_.journalGaps();
  out_.epochs = static_cast<std::uint32_t>(spans_.size());
  for (const auto& [epoch, span] : spans_) out_.duration_s += span.last_s - span.first_s;
  out_.wall_duration_s = static_cast<double>(last_time_ns_ - first_time_ns_) * 1e-9;
  if (out_.frame_stats > 0) out_.mean_real_time_factor = real_time_factors_ / static_cast<double>(out_.frame_stats);
  addLedgers();
  out_.reason = replay_.reason();
  out_.replayable = out_.reason.empty();
  out_.truncated = reader.truncated();
  out_.truncation_reason = reader.truncationReason();
  out_.file_bytes = reader.fileBytes();
  applyMetadata(reader);
  return out_;
}

}  // namespace

Result<RecordingSummary> summarize(RecordingReader& reader) {
  if (::bleedsim::Status status = reader.verify(); !status) return status;
  const std::set<Topic> all{Topic::frame, Topic::frame_stats, Topic::status, Topic::journal, Topic::scene};
  reader.select(all);
  Collector collector;
  for (;;) {
    RecordedMessage message;
    Result<bool> more = reader.next(message);
    if (!more) return more.status();
    if (!*more) break;
    if (::bleedsim::Status status = collector.add(message); !status) return status;
  }
  reader.rewind();
  return collector.finish(reader);
}

}  // namespace bleedsim::recording
