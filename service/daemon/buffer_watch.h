// Warns when a subscriber's kernel buffer is too small for the frames of the session.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace bleedsim::daemon {

class BufferWatch {
 public:
  /// `limit`: the largest receive buffer of this host in bytes; 0, not known, never warns.
  explicit BufferWatch(std::size_t limit) : limit_{limit} {}

  /// Told the payload of a frame at full capacity, again and again. A warning with its remedy if the buffer does not hold two of
  /// them, once for each new size.
  std::optional<std::string> note(std::size_t frame_bytes);

 private:
  std::size_t limit_;
  std::size_t frame_bytes_ = 0;
};

}  // namespace bleedsim::daemon
