#include "clients/bleedctl/record_narrator.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::bleedctl {
namespace {

using client::SessionState;

/// Why no frames come in this state; empty where they do, or where the recording ends anyway.
std::string silenceText(SessionState state, const std::string& text) {
  switch (state) {
    case SessionState::paused:
      return "is paused: nothing is recorded until it resumes (bleedctl resume)";
    case SessionState::loading:
      return "is loading a scene: nothing is recorded until it runs";
    case SessionState::faulted:
      return fmt::format("is faulted{}{}: nothing is recorded until a reset or another scene", text.empty() ? "" : ", ", text);
    case SessionState::running:
    case SessionState::stopped:
    case SessionState::unknown:
      break;
  }
  return {};
}

}  // namespace

std::string RecordNarrator::news(const client::RecordingProgress& progress) {
  std::string out;
  const char* start = terminal_ ? "\r\x1b[K" : "";  // over the progress
  if (progress.state != shown_) {
    const std::string silence = silenceText(progress.state, progress.state_text);
    if (!silence.empty()) {
      out += fmt::format("{}session '{}' {}\n", start, session_, silence);
      shown_ = progress.state;
    } else if (progress.state == SessionState::running) {
      out += fmt::format("{}session '{}' runs again, it is recorded\n", start, session_);
      shown_ = progress.state;
    }
  }
  if (!progress.buffer_warning.empty() && progress.buffer_warning != warned_) {
    warned_ = progress.buffer_warning;
    out += fmt::format("{}warning: {}\n", start, warned_);
  }
  if (!started_ && progress.frames > 0) {
    started_ = true;
    if (!terminal_) out += fmt::format("recording session '{}' into '{}'; Ctrl-C ends it\n", session_, path_);
  }
  return out;
}

std::string RecordNarrator::closing(const std::string& failure) const {
  const std::string why = failure.empty() ? fmt::format("the disk takes its time for '{}'", path_) : failure;
  return fmt::format("{}{}: writing what is left; Ctrl-C gives it up\n", terminal_ ? "\r\x1b[K" : "", why);
}

std::string RecordNarrator::bar(const client::RecordingProgress& progress, const client::RecordingLimits& limits) const {
  if (!terminal_) return {};
  constexpr std::size_t kWidth = 30;
  std::string bar;
  if (limits.duration_s || limits.frames) {
    const double by_time = limits.duration_s ? progress.recorded_s / *limits.duration_s : 0.0;
    const double by_frames = limits.frames ? static_cast<double>(progress.frames) / static_cast<double>(*limits.frames) : 0.0;
    const double share = std::clamp(std::max(by_time, by_frames), 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(kWidth));
    bar = fmt::format("[{}{}] {:3.0f} % ", std::string(filled, '#'), std::string(kWidth - filled, '.'), share * 100.0);
  }
  return fmt::format("\r{}{:.2f} s, {} frames, {} gaps, {} particles, {:.1f} MB\x1b[K", bar, progress.recorded_s, progress.frames,
                     progress.gaps, progress.particles, static_cast<double>(progress.bytes) * 1e-6);
}

}  // namespace bleedsim::bleedctl
