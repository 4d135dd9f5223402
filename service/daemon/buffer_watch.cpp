#include "service/daemon/buffer_watch.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::daemon {
namespace {

// What config/dds/60-bleedsim.conf sets and the participants ask for.
constexpr std::size_t kUsualBuffer = 4'194'304;

}  // namespace

std::optional<std::string> BufferWatch::note(std::size_t frame_bytes) {
  if (frame_bytes == frame_bytes_) return {};
  frame_bytes_ = frame_bytes;
  const std::size_t wanted = 2 * frame_bytes;
  if (limit_ == 0 || limit_ >= wanted) return {};
  return fmt::format(
      "the kernel's receive buffers hold {} kB, two full frames of this scene and its attributes are {} kB: frames may be lost "
      "at "
      "a subscriber. Remedy: sysctl -w net.core.rmem_max={} (config/dds/60-bleedsim.conf)",
      limit_ / 1000, wanted / 1000, std::max(wanted, kUsualBuffer));
}

}  // namespace bleedsim::daemon
