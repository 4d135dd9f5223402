#include "clients/lib/recording_end.h"

#include <algorithm>

namespace bleedsim::client {

void RecordingEnd::frame(std::uint64_t seq, const RunPlace& place) {
  frame_seq_ = seq;
  frame_ = place;
}

void RecordingEnd::stats(std::uint64_t seq) { stats_seq_ = std::max(stats_seq_, seq); }

// The daemon publishes in rounds: a frame, its statistics, the journal up to it, now and then the status. The statistics of the
// next frame, or a status of the same step, therefore follow the inputs of the last frame.
bool RecordingEnd::lastFrameWhole() const {
  if (frame_seq_ == 0) return true;
  return stats_seq_ > frame_seq_ || (stats_seq_ == frame_seq_ && !(status_ < frame_));
}

bool RecordingEnd::over(std::int64_t now_ns) {
  if (lost_ || writers_gone_) return true;
  if (!enough_ && !stopped_) return false;
  if (grace_from_ns_ == 0) grace_from_ns_ = now_ns;
  if (now_ns - grace_from_ns_ >= kGraceNs) return true;
  if (enough_) return lastFrameWhole();
  // A last status that stands after the last frame does not tell whether another one came between.
  return frame_seq_ > 0 && stats_seq_ == frame_seq_ && status_ == frame_;
}

}  // namespace bleedsim::client
