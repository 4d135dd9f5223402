// Arguments that several commands on recordings take.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "service/recording/frame_selection.h"

namespace bleedsim::bleedctl {

struct RecordingArguments {
  std::string path;
  std::string output;
  std::uint64_t every = 1;
  std::uint64_t frame = 0;
  CLI::Option* one_frame = nullptr;
  CLI::Option* each = nullptr;

  /// Adds FILE, --every and --frame to a command.
  void addTo(CLI::App& command) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 40U;
    command.add_option("FILE", path, "Recording")->required()->type_name("");
    each = command.add_option("--every", every, "Each N-th frame, from the first")
               ->check(CLI::Range(std::uint64_t{1}, kMost))
               ->type_name("N");
    one_frame = command.add_option("--frame", frame, "Only this frame, counted from 0")
                    ->check(CLI::Range(std::uint64_t{0}, kMost))
                    ->type_name("N");
    one_frame->excludes(each);
  }
  recording::FrameSelection selection() const {
    recording::FrameSelection out;
    out.every = every;
    if (one_frame->count() > 0) out.frame = frame;
    return out;
  }
};

}  // namespace bleedsim::bleedctl
