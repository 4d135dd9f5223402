// The kernel's receive buffer of this process: how much is asked for, what the host grants, and whether frames fit.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace bleedsim::transport {

/// Bytes that each participant asks for: two frames of a million particles with velocity. A limit, not a reservation: memory is
/// taken only while samples wait. The kernel grants net.core.rmem_max at most.
inline constexpr std::size_t kReceiveBufferBytes = std::size_t{64} << 20;

/// net.core.rmem_max in bytes, 0 when it cannot be read: the largest receive buffer that a process of this host gets.
std::size_t receiveBufferLimit();

/// What lacks for frames of a size, and what helps.
struct BufferShortage {
  std::string text;
  std::string remedy;
};

/// Whether buffers of a host with this limit, see receiveBufferLimit(), are too small for two frames of this payload. A limit of
/// 0, not known, is never.
std::optional<BufferShortage> findShortage(std::size_t limit, std::size_t frame_bytes);

/// Warns when the receive buffers of this host are too small for the frames of a session: less than two of them loses frames.
class BufferWatch {
 public:
  /// `limit`: see receiveBufferLimit(); 0, not known, never warns.
  explicit BufferWatch(std::size_t limit) : limit_{limit} {}

  /// Told the payload of a frame at full capacity, again and again. A warning with its remedy if the buffer does not hold two of
  /// them, once for each new size.
  std::optional<std::string> note(std::size_t frame_bytes);

 private:
  std::size_t limit_;
  std::size_t frame_bytes_ = 0;
};

}  // namespace bleedsim::transport
