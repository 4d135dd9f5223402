// How a recording ended, for people and scripts. No session and no file in here.
#pragma once

#include <string>

#include "bleedsim/recorder.h"
#include "clients/bleedctl/exit_codes.h"

namespace bleedsim::bleedctl {

struct RecordOutcome {
  ExitCode code = kDone;
  const char* ended_by = "limit";
  std::string problem{};  ///< empty when the recording is all that was asked for
};

/// `closed`: what Recorder::close() said.
RecordOutcome judgeRecording(const std::string& session, const client::RecordingProgress& progress,
                             const client::RecordingLimits& limits, const Status& closed);

/// Of a failed Recorder: only a file that fails is kFile.
ExitCode recordExitCode(const Status& failure);

}  // namespace bleedsim::bleedctl
