// The exclusive lease: while a client holds it, the others may watch and ping, and nothing else.
#include <fmt/core.h>

#include "service/daemon/simulation.h"

namespace bleedsim::daemon {

Result<sph::Applied> Simulation::acquireLease(const dds::DecodedRequest& request, TimePoint now) {
  const double seconds = std::get<dds::AcquireLease>(request.action).seconds;
  const auto length = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{seconds});
  const dds::Uuid& client = request.key.origin.client;
  if (!lease_.acquire(client, request.writer, length, now)) return leasedToOther(now);
  for (std::size_t i = instruments_.tools().size(); i-- > 0;) {
    if (instruments_.tools()[i].sample.key.client != client) endInstrument(i, dds::InstrumentEndReason::expired);
  }
  showState();
  return sph::Applied{};
}

Result<sph::Applied> Simulation::releaseLease(const dds::DecodedRequest& request, TimePoint now) {
  if (!lease_.release(request.key.origin.client, now)) {
    return Status{StatusCode::wrong_state, "you hold no lease: it was released, has expired or was never acquired"};
  }
  showState();
  return sph::Applied{};
}

Status Simulation::leasedToOther(TimePoint now) const {
  const double left = std::chrono::duration<double>{lease_.until() - now}.count();
  return {StatusCode::unavailable,
          fmt::format("client {:.8} has the lease for up to {:.1f} s more: ask it to release it, or wait",
                      transport::toString(lease_.holder()), left)};
}

}  // namespace bleedsim::daemon
