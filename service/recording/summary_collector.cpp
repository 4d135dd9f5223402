#include "service/recording/summary_collector.h"

#include <algorithm>

namespace bleedsim::recording {

::bleedsim::Status SummaryCollector::add(const RecordedMessage& message) {
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

::bleedsim::Status SummaryCollector::addFrame(const RecordedMessage& message) {
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
  for (const Attribute& attribute : frame_.attributes()) errors_.add(attribute);
  const auto [span, fresh] =
      spans_.try_emplace(epoch, FrameSpan{frame_.seq(), frame_.seq(), frame_.sim_time_s(), frame_.sim_time_s()});
  if (!fresh) {
    span->second.last_seq = frame_.seq();
    span->second.last_s = frame_.sim_time_s();
  }
  return {};
}

::bleedsim::Status SummaryCollector::addStats(const RecordedMessage& message) {
  if (::bleedsim::Status status = decode(message, stats_); !status) return status;
  ++out_.frame_stats;
  out_.fault_counters.clear();
  for (const Counter& counter : stats_.fault_counters()) out_.fault_counters.emplace_back(counter.name(), counter.value());
  real_time_factors_ += stats_.real_time_factor();
  out_.max_behind_s = std::max(out_.max_behind_s, stats_.behind_s());
  replay_.addState(stats_.session(), stats_.epoch(), stats_.journal_number());
  ledger_.push_back({Epoch{stats_.session(), stats_.epoch()}, {stats_.seq(), stats_.emitted_ml()}});
  return {};
}

::bleedsim::Status SummaryCollector::addScene(const RecordedMessage& message) {
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

::bleedsim::Status SummaryCollector::addJournal(const RecordedMessage& message) {
  Journal journal;
  if (::bleedsim::Status status = decode(message, journal); !status) return status;
  ++out_.journal_entries;
  replay_.addJournal(journal.session(), journal.epoch(), journal.number());
  if (journal.has_restored()) {
    const Restored& source = journal.restored();
    replay_.addRestored(journal.session(), journal.epoch(), source.session(), source.epoch(), source.number());
  }
  return {};
}

void SummaryCollector::addLedgers() {
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

void SummaryCollector::apply(const WriterKnowledge& knowledge) {
  frames_.publishedUntil(last_epoch_.first, knowledge.published_until);
  out_.gaps = frames_.missing();
  out_.gap_ranges = frames_.ranges();
  out_.skipped = knowledge.skipped;
  if (knowledge.skipped > 0) {
    out_.gaps = knowledge.gaps;
    out_.gap_ranges.clear();
  }
  if (knowledge.thinned) {
    out_.skipped = out_.gaps;
    out_.gaps = 0;
    out_.gap_ranges.clear();
  }
  if (out_.replayable && !knowledge.not_replayable.empty()) {
    out_.replayable = false;
    out_.reason = knowledge.not_replayable;
  }
}

RecordingSummary SummaryCollector::finish(const WriterKnowledge& knowledge) {
  out_.journal_gaps = replay_.journalGaps();
  out_.epochs = static_cast<std::uint32_t>(spans_.size());
  for (const auto& [epoch, span] : spans_) out_.duration_s += span.last_s - span.first_s;
  out_.wall_duration_s = static_cast<double>(last_time_ns_ - first_time_ns_) * 1e-9;
  if (out_.frame_stats > 0) out_.mean_real_time_factor = real_time_factors_ / static_cast<double>(out_.frame_stats);
  addLedgers();
  out_.max_errors = errors_.byName();
  out_.reason = replay_.reason();
  out_.replayable = out_.reason.empty();
  apply(knowledge);
  return out_;
}

}  // namespace bleedsim::recording
