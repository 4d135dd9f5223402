#include "clients/bleedctl/record_outcome.h"

#include <fmt/core.h>

namespace bleedsim::bleedctl {
namespace {

std::string howItEnded(const client::RecordingProgress& progress) {
  if (progress.state == client::SessionState::stopped) return "ended";
  return progress.replaced ? "is gone, another daemon has taken its name" : "is gone, its daemon was lost";
}

const char* whatFailed(StatusCode code) {
  if (code == StatusCode::io) return "file";
  return code == StatusCode::unavailable ? "middleware" : "error";
}

}  // namespace

ExitCode recordExitCode(const Status& failure) {
  switch (failure.code()) {
    case StatusCode::io:
      return kFile;
    case StatusCode::invalid_argument:
      return kUsage;
    default:
      return kFailed;
  }
}

RecordOutcome judgeRecording(const std::string& session, const client::RecordingProgress& progress,
                             const client::RecordingLimits& limits, const Status& closed) {
  const bool limited = limits.frames.has_value() || limits.duration_s.has_value();
  if (!closed.ok()) return {recordExitCode(closed), whatFailed(closed.code()), closed.message()};
  if (progress.complete) return {};
  if (progress.session_gone) {
    if (!limited && progress.state == client::SessionState::stopped) return {kDone, "session"};
    return {kNoSession, "session", fmt::format("session '{}' {}", session, howItEnded(progress))};
  }
  return limited ? RecordOutcome{kInterrupted, "interrupt", "interrupted"} : RecordOutcome{kDone, "interrupt"};
}

}  // namespace bleedsim::bleedctl
