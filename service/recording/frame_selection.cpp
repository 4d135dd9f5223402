#include "service/recording/frame_selection.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::recording {

Result<std::vector<std::size_t>> selectFrames(const FrameSelection& selection, std::size_t total) {
  if (total == 0) return ::bleedsim::Status{StatusCode::not_found, "the recording holds no frames"};
  if (selection.every == 0) return ::bleedsim::Status{StatusCode::invalid_argument, "each 0 frames is no choice: give 1 or more"};
  if (selection.frame) {
    if (*selection.frame < total) return std::vector<std::size_t>{*selection.frame};
    return ::bleedsim::Status{
        StatusCode::invalid_argument,
        fmt::format("there is no frame {}: the recording has {}, numbered 0 to {}", *selection.frame, total, total - 1)};
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < total; i += std::min(selection.every, total)) out.push_back(i);
  return out;
}

std::size_t numberDigits(std::size_t total) {
  return std::max<std::size_t>(6, std::to_string(total == 0 ? 0 : total - 1).size());
}

}  // namespace bleedsim::recording
