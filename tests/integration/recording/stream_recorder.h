// Records a session's topics from the wire, as a client does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "service/recording/recording_writer.h"
#include "service/transport/wait_set.h"

namespace bleedsim::recording_test {

class StreamRecorder {
 public:
  static Result<StreamRecorder> create(const transport::Participant& participant, const std::string& session,
                                       const std::filesystem::path& file);

  /// Records what arrives until `done` holds; timed_out when nothing arrives for 20 s.
  Status recordUntil(const std::function<bool(const recording::WriterCounts&)>& done);
  Status close() { return writer_.close(); }
  const recording::WriterCounts& counts() const { return writer_.counts(); }

 private:
  StreamRecorder(recording::RecordingWriter writer, transport::WaitSet waits, transport::Reader<bleed_v1_Frame> frames,
                 transport::Reader<bleed_v1_FrameStats> stats, transport::Reader<bleed_v1_Scene> scenes,
                 transport::Reader<bleed_v1_Status> statuses, transport::Reader<bleed_v1_Journal> journal);

  Status drain();

  recording::RecordingWriter writer_;
  transport::Reader<bleed_v1_Frame> frames_;
  transport::Reader<bleed_v1_FrameStats> stats_;
  transport::Reader<bleed_v1_Scene> scenes_;
  transport::Reader<bleed_v1_Status> statuses_;
  transport::Reader<bleed_v1_Journal> journal_;
  transport::WaitSet waits_;
};

}  // namespace bleedsim::recording_test
