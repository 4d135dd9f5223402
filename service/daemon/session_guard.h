// One daemon per session name and domain: looks for others of the same name on the status topic.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "service/dds/session_report.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"

namespace bleedsim::daemon {

/// What daemons of one session name know of each other.
struct Contender {
  dds::Uuid uuid{};
  std::int64_t start_stamp_ns = 0;  ///< CLOCK_REALTIME
  std::uint64_t heartbeat = 0;      ///< of the newest status
};

/// Another daemon of the same session name.
struct Rival : Contender {
  std::string host;
  std::int32_t pid = 0;
};

/// A daemon is established after this many of its own status samples: from then on it never gives way to a new one.
inline constexpr std::uint64_t kEstablishedHeartbeat = 8;

/// Which of two daemons that see each other ends: both come to the same answer. An established one stays. Two established ones
/// meet when they could not hear each other for a while: the one that started first stays. Of two that are new, and of two that
/// started at the same time, the one with the lower uuid does.
bool mustGiveWay(const Contender& own, const Contender& rival);

/// "session 'x' is run by another bleedd already: host h, process 7; ..."
Status nameTaken(const std::string& session, const Rival& rival);

class SessionGuard {
 public:
  static Result<SessionGuard> create(const transport::Participant& participant, const dds::SessionIdentity& identity);

  /// Listens for a living session of the same name until one is heard or `window` has passed.
  Result<std::optional<Rival>> listen(std::chrono::nanoseconds window);

  /// The newest status of another living daemon of this name since the last call. Never waits.
  std::optional<Rival> poll();

 private:
  SessionGuard(dds::Uuid own, transport::Reader<bleed_v1_Status> reader, transport::WaitSet wait_set)
      : own_{own}, reader_{std::move(reader)}, wait_set_{std::move(wait_set)} {}

  dds::Uuid own_;
  transport::Reader<bleed_v1_Status> reader_;
  transport::WaitSet wait_set_;
};

}  // namespace bleedsim::daemon
