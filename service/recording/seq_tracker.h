// What is missing from a stream of frames and from a journal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace bleedsim::recording {

/// The 16 bytes of a session's identity.
using SessionKey = std::string;

/// Frames by seq, which rises by one for each published frame of a session, across epochs.
class FrameTracker {
 public:
  using Range = std::pair<std::uint64_t, std::uint64_t>;
  static constexpr std::size_t kMaxRanges = 1000;
  static constexpr std::size_t kMaxSessions = 64;

  /// Another session, or a seq that falls in a new epoch, starts afresh; a repeated or older seq is no gap.
  void add(const SessionKey& session, std::uint32_t epoch, std::uint64_t seq);
  /// The session had published frames up to this one: those after its last are missing. A session without frames has no gaps.
  void publishedUntil(const SessionKey& session, std::uint64_t seq);

  std::uint64_t missing() const { return missing_; }
  /// First and last of each run of missing frames, the first kMaxRanges of them.
  const std::vector<Range>& ranges() const { return ranges_; }

 private:
  struct Last {
    std::uint32_t epoch = 0;
    std::uint64_t seq = 0;
  };

  void lose(std::uint64_t first, std::uint64_t last);

  std::map<SessionKey, Last> last_;
  std::uint64_t missing_ = 0;
  std::vector<Range> ranges_;
};

/// Whether a recording can be played again: one session, its scene, and the journal from number 1 to the last entry that a state
/// contains, of each epoch with frames and of each whose state another one goes on from.
class ReplayCheck {
 public:
  static constexpr std::size_t kMaxEpochs = 100'000;

  void addFrame(const SessionKey& session, std::uint32_t epoch);
  void addScene(const SessionKey& session, std::uint32_t epoch);
  void addJournal(const SessionKey& session, std::uint32_t epoch, std::uint64_t number);
  /// A state of that epoch contains so many journal entries.
  void addState(const SessionKey& session, std::uint32_t epoch, std::uint64_t journal_number);
  /// The epoch goes on from a state of the source.
  void addRestored(const SessionKey& session, std::uint32_t epoch, const SessionKey& source_session, std::uint32_t source_epoch,
                   std::uint64_t journal_number);
  /// An entry of that epoch could not be stored.
  void loseJournal(const SessionKey& session, std::uint32_t epoch);

  std::uint64_t journalGaps() const { return journal_gaps_; }
  std::size_t epochs() const { return frames_.size(); }
  /// Empty when the recording can be played again.
  std::string reason() const;

 private:
  using Epoch = std::pair<SessionKey, std::uint32_t>;
  struct Journal {
    std::uint64_t last = 0;
    std::uint64_t missing = 0;
    std::uint64_t needed = 0;  // entries that a state contains
  };

  bool hasScene(const Epoch& epoch) const;
  std::string journalReason(std::uint32_t epoch, const Journal& journal) const;

  std::set<Epoch> frames_;
  std::set<Epoch> scenes_;
  std::map<Epoch, Journal> journals_;
  std::map<Epoch, Epoch> sources_;
  std::uint64_t journal_gaps_ = 0;
  bool overflow_ = false;
};

}  // namespace bleedsim::recording
