// What a recording reads: the topics of one session, reliably and with a deep history, and what the middleware knows of the
// writers.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "service/transport/participant.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"

namespace bleedsim::client {

/// Every error is `unavailable`: the middleware failed, not a file. Move-only; one thread uses it, any may wake it.
class RecorderInputs {
 public:
  /// All but the frames.
  static Result<RecorderInputs> open(const transport::Participant& participant, const std::string& session);

  /// Sleeps until there are samples, wake() was called, or the time is over.
  Status wait(std::chrono::nanoseconds timeout);
  /// Ends the wait that is under way, or the next one. From any thread.
  void wake() { guard_.raise(); }

  /// Frames come only once the journal flows: a recording starts with what explains it.
  bool journalFlows() const { return journal_.matchedCount() > 0; }
  bool framesOpen() const { return frames_.has_value(); }
  Status openFrames();

  /// Gives every sample that the readers hold to use(const Sample<T>&), topic by topic.
  template <class Use>
  Status take(Use&& use) {
    Status taken = drain(scene_, use);
    if (taken) taken = drain(journal_, use);
    if (taken) taken = drain(status_, use);
    if (taken && frames_) taken = drain(*frames_, use);
    if (taken) taken = drain(stats_, use);
    return taken;
  }

  /// That status writer is gone, or no writer holds its liveliness any more.
  bool statusLost(transport::PublicationHandle writer) const;
  /// Those writers are gone; 0 stands for one that was never heard, and is gone when there is none at all.
  bool streamsGone(transport::PublicationHandle frames, transport::PublicationHandle stats) const;

 private:
  RecorderInputs(transport::Participant participant, std::string session, transport::Reader<bleed_v1_Journal> journal,
                 transport::Reader<bleed_v1_Scene> scene, transport::Reader<bleed_v1_Status> status,
                 transport::Reader<bleed_v1_FrameStats> stats, transport::GuardCondition guard, transport::WaitSet waits);

  static Status failed(const Status& cause);
  template <class T, class Use>
  static Status drain(transport::Reader<T>& reader, Use& use) {
    for (;;) {
      const Result<std::size_t> taken = reader.take([&](const transport::Sample<T>& sample) {
        if (sample.data != nullptr) use(sample);
      });
      if (!taken) return failed(taken.status());
      if (*taken < transport::Reader<T>::kMaxBatch) return {};
    }
  }

  transport::Participant participant_;
  std::string session_;
  transport::Reader<bleed_v1_Journal> journal_;
  transport::Reader<bleed_v1_Scene> scene_;
  transport::Reader<bleed_v1_Status> status_;
  transport::Reader<bleed_v1_FrameStats> stats_;
  std::optional<transport::Reader<bleed_v1_Frame>> frames_;
  transport::GuardCondition guard_;
  transport::WaitSet waits_;  // last: it watches the others
};

}  // namespace bleedsim::client
