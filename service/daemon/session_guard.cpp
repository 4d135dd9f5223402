#include "service/daemon/session_guard.h"

#include <fmt/core.h>

#include "service/daemon/wakeup.h"
#include "service/dds/bounded_text.h"

namespace bleedsim::daemon {

// The start stamps decide between established daemons only: clocks of two hosts may differ, and what runs must not end because a
// new daemon's clock is late.
bool mustGiveWay(const Contender& own, const Contender& rival) {
  const bool established = own.heartbeat >= kEstablishedHeartbeat;
  const bool rival_established = rival.heartbeat >= kEstablishedHeartbeat;
  if (established != rival_established) return rival_established;
  if (established && own.start_stamp_ns != rival.start_stamp_ns) return rival.start_stamp_ns < own.start_stamp_ns;
  return rival.uuid < own.uuid;
}

Status nameTaken(const std::string& session, const Rival& rival) {
  return {StatusCode::unavailable,
          fmt::format("session '{}' is run by another bleedd already (host {}, process {}): stop that one, or start with another "
                      "--session name or --domain",
                      session, rival.host, rival.pid)};
}

Result<SessionGuard> SessionGuard::create(const transport::Participant& participant, const dds::SessionIdentity& identity) {
  auto reader = transport::Reader<bleed_v1_Status>::create(
      participant, identity.name, transport::readerQos(transport::Topic::status, transport::Reading::discovery));
  if (!reader) return reader.status();
  Result<transport::WaitSet> wait_set = transport::WaitSet::create(participant);
  if (!wait_set) return wait_set.status();
  if (Status attached = wait_set->attach(*reader, 0); !attached) return attached;
  return SessionGuard{identity.uuid, std::move(*reader), std::move(*wait_set)};
}

Result<std::optional<Rival>> SessionGuard::listen(std::chrono::nanoseconds window) {
  const TimePoint end = Clock::now() + window;
  for (;;) {
    if (std::optional<Rival> rival = poll()) return rival;
    const Clock::duration left = end - Clock::now();
    if (left <= Clock::duration::zero()) return std::optional<Rival>{};
    if (const auto woken = wait_set_.wait(left); !woken) return woken.status();
  }
}

std::optional<Rival> SessionGuard::poll() {
  std::optional<Rival> found;
  const auto look = [this, &found](const transport::Sample<bleed_v1_Status>& sample) {
    if (sample.data == nullptr || sample.data->state == bleed_v1_STATE_STOPPED) return;
    const dds::Uuid uuid = transport::toUuid(sample.data->session);
    if (uuid == own_) return;
    found = Rival{{uuid, sample.data->start_stamp_ns, sample.data->heartbeat},
                  std::string{dds::viewText(sample.data->host)},
                  sample.data->pid};
  };
  for (;;) {
    const Result<std::size_t> taken = reader_.take(look);
    if (!taken || *taken == 0) return found;
  }
}

}  // namespace bleedsim::daemon
