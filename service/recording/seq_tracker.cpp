#include "service/recording/seq_tracker.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::recording {

void FrameTracker::add(const SessionKey& session, std::uint32_t epoch, std::uint64_t seq) {
  const auto found = last_.find(session);
  if (found == last_.end()) {
    if (last_.size() < kMaxSessions) last_[session] = {epoch, seq};
    return;
  }
  Last& last = found->second;
  if (seq > last.seq) {
    if (seq > last.seq + 1) lose(last.seq + 1, seq - 1);
    last = {epoch, seq};
  } else if (epoch != last.epoch) {
    last = {epoch, seq};
  }
}

void FrameTracker::publishedUntil(const SessionKey& session, std::uint64_t seq) {
  const auto found = last_.find(session);
  if (found == last_.end() || seq <= found->second.seq) return;
  lose(found->second.seq + 1, seq);
  found->second.seq = seq;
}

void FrameTracker::lose(std::uint64_t first, std::uint64_t last) {
  missing_ += last - first + 1;
  if (ranges_.size() < kMaxRanges) ranges_.emplace_back(first, last);
}

void ReplayCheck::addFrame(const SessionKey& session, std::uint32_t epoch) {
  if (frames_.size() < kMaxEpochs) {
    frames_.emplace(session, epoch);
  } else if (!frames_.contains({session, epoch})) {
    overflow_ = true;
  }
}

void ReplayCheck::addScene(const SessionKey& session, std::uint32_t epoch) {
  if (scenes_.size() < kMaxEpochs) scenes_.emplace(session, epoch);
}

void ReplayCheck::addJournal(const SessionKey& session, std::uint32_t epoch, std::uint64_t number) {
  const Epoch key{session, epoch};
  if (journals_.size() >= kMaxEpochs && !journals_.contains(key)) {
    overflow_ = true;
    return;
  }
  Journal& journal = journals_[key];
  if (number <= journal.last) return;
  const std::uint64_t lost = number - journal.last - 1;
  journal.missing += lost;
  journal_gaps_ += lost;
  journal.last = number;
}

void ReplayCheck::addState(const SessionKey& session, std::uint32_t epoch, std::uint64_t journal_number) {
  const Epoch key{session, epoch};
  if (journal_number == 0) return;
  if (journals_.size() >= kMaxEpochs && !journals_.contains(key)) {
    overflow_ = true;
    return;
  }
  Journal& journal = journals_[key];
  journal.needed = std::max(journal.needed, journal_number);
}

void ReplayCheck::addRestored(const SessionKey& session, std::uint32_t epoch, const SessionKey& source_session,
                              std::uint32_t source_epoch, std::uint64_t journal_number) {
  if (sources_.size() < kMaxEpochs) sources_[{session, epoch}] = {source_session, source_epoch};
  if (source_session == session) addState(session, source_epoch, journal_number);
}

void ReplayCheck::loseJournal(const SessionKey& session, std::uint32_t epoch) {
  // The next entry's number shows the loss again, so only the epoch is marked here.
  if (journals_.size() >= kMaxEpochs) {
    overflow_ = true;
    return;
  }
  ++journals_[{session, epoch}].missing;
}

bool ReplayCheck::hasScene(const Epoch& epoch) const {
  for (const Epoch& scene : scenes_) {
    if (scene.first == epoch.first && scene.second <= epoch.second) return true;
  }
  return false;
}

std::string ReplayCheck::reason() const {
  if (frames_.empty()) return "it holds no frames";
  if (frames_.begin()->first != frames_.rbegin()->first) return "it holds frames of more than one session";
  if (overflow_) return fmt::format("it holds more than {} epochs", kMaxEpochs);
  for (const Epoch& epoch : frames_) {
    if (!hasScene(epoch)) return fmt::format("the scene of epoch {} is missing", epoch.second);
    const auto journal = journals_.find(epoch);
    if (journal == journals_.end()) continue;
    if (std::string reason = journalReason(epoch.second, journal->second); !reason.empty()) return reason;
  }
  for (const auto& [epoch, source] : sources_) {
    if (!frames_.contains(epoch)) continue;
    if (source.first != epoch.first) {
      return fmt::format("epoch {} begins with a checkpoint of another session, which is not in the file", epoch.second);
    }
    if (!hasScene(source)) return fmt::format("the scene of epoch {} is missing", source.second);
    const auto journal = journals_.find(source);
    if (journal == journals_.end()) continue;
    if (std::string reason = journalReason(source.second, journal->second); !reason.empty()) return reason;
  }
  return {};
}

std::string ReplayCheck::journalReason(std::uint32_t epoch, const Journal& journal) const {
  const std::uint64_t after = journal.needed > journal.last ? journal.needed - journal.last : 0;
  if (journal.missing + after == 0) return {};
  return fmt::format("{} journal entries of epoch {} are missing", journal.missing + after, epoch);
}

}  // namespace bleedsim::recording
