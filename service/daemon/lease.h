// The exclusive right of one client to command a session, for a while.
#pragma once

#include <cstdint>

#include "service/daemon/wakeup.h"
#include "service/dds/identity.h"

namespace bleedsim::daemon {

/// Belongs to the simulation thread.
class Lease {
 public:
  /// False: another client holds it. The holder may acquire it again, which sets its end anew. `writer` is the one its requests
  /// come by.
  bool acquire(const dds::Uuid& client, std::uint64_t writer, Clock::duration length, TimePoint now) {
    if (bars(client, now)) return false;
    holder_ = client;
    writer_ = writer;
    until_ = now + length;
    return true;
  }
  /// False: `client` does not hold it.
  bool release(const dds::Uuid& client, TimePoint now) {
    if (!heldAt(now) || client != holder_) return false;
    *this = {};
    return true;
  }
  /// True: it was the holder's, which has lost its lease with it.
  bool loseWriter(std::uint64_t writer, TimePoint now) {
    if (!heldAt(now) || writer != writer_) return false;
    *this = {};
    return true;
  }

  bool heldAt(TimePoint now) const { return now < until_; }
  bool bars(const dds::Uuid& client, TimePoint now) const { return heldAt(now) && client != holder_; }
  const dds::Uuid& holder() const { return holder_; }
  TimePoint until() const { return until_; }

 private:
  dds::Uuid holder_{};
  std::uint64_t writer_ = 0;
  TimePoint until_{};
};

}  // namespace bleedsim::daemon
