// A tool in the trainee's hand, streamed to one session.
#pragma once

#include <memory>
#include <string>

#include "bleedsim/types.h"

namespace bleedsim::client {

struct InstrumentSample {
  Vec3 position{};  ///< of the tip, m
  Quaternion orientation{0.0, 0.0, 0.0, 1.0};
  double tip_radius_m = 0.0;
  Vec3 force{};  ///< on the fluid, N
};

/// Made by Session::instrument. Its force ends when samples stop (100 ms by default) or the stream is destroyed.
/// send() is for one thread; other streams and the session may be used beside it.
class InstrumentStream {
 public:
  InstrumentStream(InstrumentStream&&) noexcept;
  InstrumentStream& operator=(InstrumentStream&&) noexcept;
  ~InstrumentStream();

  /// timed_out: the service takes too little, the sample is dropped after 20 ms.
  Status send(const InstrumentSample& sample);
  /// Number of the last sample, from 1; FrameStats::instruments tells the last one used.
  std::uint64_t lastSeq() const;

 private:
  friend class Session;
  class Impl;
  explicit InstrumentStream(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::client
