// Which frames of a recording are exported or drawn.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::recording {

struct FrameSelection {
  std::optional<std::size_t> frame{};  ///< only this one, counted from 0
  std::size_t every = 1;               ///< else each so many, from the first; at least 1
};

/// Numbers of frames, rising. not_found: the recording has none; invalid_argument: it has no such frame, the message says how
/// many there are.
Result<std::vector<std::size_t>> selectFrames(const FrameSelection& selection, std::size_t total);

/// Digits that the numbers of all frames need in file names, at least 6.
std::size_t numberDigits(std::size_t total);

}  // namespace bleedsim::recording
