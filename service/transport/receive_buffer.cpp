#include "service/transport/receive_buffer.h"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>

namespace bleedsim::transport {

std::size_t receiveBufferLimit() {
  std::ifstream file{"/proc/sys/net/core/rmem_max"};
  std::size_t bytes = 0;
  return file >> bytes ? bytes : 0;
}

std::optional<BufferShortage> findShortage(std::size_t limit, std::size_t frame_bytes) {
  const std::size_t needed = 2 * frame_bytes;
  const std::size_t granted = std::min(limit, kReceiveBufferBytes);
  if (limit == 0 || granted >= needed) return {};
  std::string remedy;
  if (granted < kReceiveBufferBytes) {
    remedy = fmt::format(
        "sysctl -w net.core.rmem_max={0} on the hosts that receive frames; the line net.core.rmem_max={0} in a .conf "
        "file in /etc/sysctl.d keeps it",
        kReceiveBufferBytes);
  }
  if (needed > kReceiveBufferBytes) {
    remedy += fmt::format("{}a smaller capacity or fewer attributes: no more than {} kB are asked for",
                          remedy.empty() ? "" : "; ", kReceiveBufferBytes / 1000);
  }
  const std::string text = fmt::format(
      "this host grants receive buffers of {} kB, two frames of this scene at full capacity need {} kB: frames that large may be "
      "lost",
      granted / 1000, needed / 1000);
  return BufferShortage{text, remedy};
}

std::optional<std::string> BufferWatch::note(std::size_t frame_bytes) {
  if (frame_bytes == frame_bytes_) return {};
  frame_bytes_ = frame_bytes;
  const std::optional<BufferShortage> shortage = findShortage(limit_, frame_bytes);
  if (!shortage) return {};
  return fmt::format("{}. Remedy: {}", shortage->text, shortage->remedy);
}

}  // namespace bleedsim::transport
