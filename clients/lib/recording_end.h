// Decides when a recording has all that it will get. The topics are streams of their own: what was published before the last
// status or frame may still be resent after it. No DDS and no file in here.
#pragma once

#include <cstdint>
#include <tuple>

namespace bleedsim::client {

/// A place in simulated time; later ones are larger.
struct RunPlace {
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;

  friend bool operator<(const RunPlace& a, const RunPlace& b) { return std::tie(a.epoch, a.step) < std::tie(b.epoch, b.step); }
  friend bool operator==(const RunPlace& a, const RunPlace& b) { return a.epoch == b.epoch && a.step == b.step; }
};

/// Told of every sample of the daemon that is recorded, in the order of arrival.
class RecordingEnd {
 public:
  /// Resends take some round trips; a peer that gives nothing for so long has no more to give.
  static constexpr std::int64_t kGraceNs = 1'000'000'000;

  /// Each frame that came while frames were wanted, kept or left out by choice.
  void frame(std::uint64_t seq, const RunPlace& place);
  void stats(std::uint64_t seq);
  void status(const RunPlace& place) { status_ = place; }

  /// A limit is reached, or the user ends the recording: no further frames are wanted.
  void enough() { enough_ = true; }
  /// The daemon says that it ends.
  void stopped() { stopped_ = true; }
  /// The daemon's writers of frames and statistics are gone: the readers hold all that will ever come.
  void writersGone() { writers_gone_ = true; }
  /// The daemon is gone without a word.
  void lost() { lost_ = true; }

  bool wantsFrames() const { return !enough_; }
  /// Statistics of frames after the last wanted one are left out.
  bool wantsStats(std::uint64_t seq) const { return !enough_ || seq <= frame_seq_; }
  bool hasStopped() const { return stopped_; }
  bool sessionGone() const { return stopped_ || lost_; }

  /// Nothing more is to come, or was waited for long enough. `now_ns` is a monotonic clock; the grace begins with the first call
  /// after a reason to end. Asked after all samples were told that the readers held.
  bool over(std::int64_t now_ns);

  /// Once over: the last frame that the statistics told of, when it is later than the last one that came and nobody chose to do
  /// without it; else 0.
  std::uint64_t missingUntil() const { return enough_ || frame_seq_ == 0 || stats_seq_ <= frame_seq_ ? 0 : stats_seq_; }

 private:
  bool lastFrameWhole() const;

  std::uint64_t frame_seq_ = 0;  // 0: none yet, the first one is 1
  std::uint64_t stats_seq_ = 0;
  RunPlace frame_;
  RunPlace status_;
  bool enough_ = false;
  bool stopped_ = false;
  bool writers_gone_ = false;
  bool lost_ = false;
  std::int64_t grace_from_ns_ = 0;
};

}  // namespace bleedsim::client
