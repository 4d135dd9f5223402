// What `record` says on stderr while it records, so that nobody takes a silent wait for a recording.
#pragma once

#include <string>
#include <utility>

#include "bleedsim/recorder.h"

namespace bleedsim::bleedctl {

class RecordNarrator {
 public:
  /// `terminal`: stderr is one, and shows the progress on a line that is redrawn.
  RecordNarrator(std::string session, std::string path, bool terminal)
      : session_{std::move(session)}, path_{std::move(path)}, terminal_{terminal} {}

  /// The lines that the progress calls for now, each with its newline; empty when there is no news.
  std::string news(const client::RecordingProgress& progress);
  /// The progress on one line, which replaces the line before; empty without a terminal.
  std::string bar(const client::RecordingProgress& progress, const client::RecordingLimits& limits) const;
  /// The line for a file that takes its time to be closed; `failure`: why the recording ended, empty when the disk is only slow.
  std::string closing(const std::string& failure) const;

 private:
  std::string session_;
  std::string path_;
  bool terminal_;
  bool started_ = false;
  client::SessionState shown_ = client::SessionState::running;
  std::string warned_;
};

}  // namespace bleedsim::bleedctl
