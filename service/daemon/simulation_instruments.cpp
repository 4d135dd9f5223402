// Instruments: what a trainer's tools do to the fluid, and how it ends.
#include "service/daemon/simulation.h"

namespace bleedsim::daemon {

void Simulation::takeSample(const InstrumentInput& input, TimePoint now) {
  if (pending_load_ || faulted_ || lease_.bars(input.sample.key.client, now)) {
    rejectSample(input.sample, ServiceCounter::instruments_refused);
    return;
  }
  std::uint64_t missed = 0;
  const InstrumentTable::Update update = instruments_.update(input, missed);
  if (missed > 0) channels_.counters.add(ServiceCounter::instruments_missed, missed);
  if (update != InstrumentTable::Update::taken) rejectSample(input.sample, ServiceCounter::instruments_dropped);
}

void Simulation::rejectSample(const dds::InstrumentSample& sample, ServiceCounter why) {
  channels_.counters.add(why);
  channels_.clients.note(sample.key.client, dds::ClientCount::instruments_rejected);
}

void Simulation::applyInstruments() {
  if (pending_load_ || faulted_) return;
  for (std::size_t i = 0; i < instruments_.tools().size();) {
    Tool& tool = instruments_.tools()[i++];
    if (!tool.pending) continue;
    tool.pending = false;
    const dds::InstrumentSample& sample = tool.sample;
    const Result<sph::Applied> applied = world_->apply(
        sph::SetForce{.key = tool.force_key, .position = sample.position, .radius = sample.radius, .force = sample.force});
    if (applied) {
      tool.applied = {sample.key.client, sample.seq, sample.client_stamp_ns, world_->stepCount() + 1};
      record(dds::InstrumentTaken{sample.original});
      continue;
    }
    rejectSample(sample, ServiceCounter::instruments_refused);
    // A tool that never pushed leaves no trace. One that did pushes no longer where it was: it may have left the domain.
    endInstrument(--i, dds::InstrumentEndReason::expired);
  }
}

void Simulation::endSilentInstruments(TimePoint now) {
  if (pending_load_) return;
  const Clock::duration expiry = instrumentExpiry();
  for (std::size_t i = instruments_.tools().size(); i-- > 0;) {
    if (instruments_.tools()[i].received + expiry <= now) endInstrument(i, dds::InstrumentEndReason::expired);
  }
}

void Simulation::endInstrumentsOf(std::uint64_t writer) {
  for (std::size_t i = instruments_.tools().size(); i-- > 0;) {
    if (instruments_.tools()[i].sample.writer == writer) endInstrument(i, dds::InstrumentEndReason::lost);
  }
}

void Simulation::endInstrument(std::size_t index, dds::InstrumentEndReason reason) {
  const Tool& tool = instruments_.tools()[index];
  if (tool.applied) {
    // A source that the world has dropped by itself is gone already; there is nothing left to end then.
    static_cast<void>(world_->apply(sph::RemoveForce{tool.force_key}));
    record(dds::InstrumentEnded{tool.sample.key, reason});
    channels_.counters.add(ServiceCounter::instruments_ended);
  }
  instruments_.remove(index);
}

}  // namespace bleedsim::daemon
