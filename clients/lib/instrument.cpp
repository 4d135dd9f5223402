#include "bleedsim/instrument.h"

#include <fmt/core.h>

#include "clients/lib/session_impl.h"
#include "clients/lib/wire_text.h"
#include "service/status/printable_text.h"
#include "service/transport/clock.h"
#include "service/transport/uuid.h"

namespace bleedsim::client {
namespace {

constexpr std::chrono::seconds kMatchTimeout{2};

bleed_v1_Vec3 wireVec3(const Vec3& v) { return {v[0], v[1], v[2]}; }

Status waitForReader(const transport::Participant& participant, transport::Writer<bleed_v1_Instrument>& writer,
                     const std::string& session) {
  Result<transport::WaitSet> waits = transport::WaitSet::create(participant);
  if (!waits) return waits.status();
  if (Status attached = waits->attachMatches(writer, 0); !attached) return attached;
  const std::int64_t deadline = transport::monotonicNow() + std::chrono::nanoseconds{kMatchTimeout}.count();
  while (writer.matchedCount() == 0) {
    const std::int64_t left = deadline - transport::monotonicNow();
    if (left <= 0) {
      return {StatusCode::timed_out, fmt::format("session '{}' does not read instruments: is it still running?", session)};
    }
    if (const Result<transport::WakeUp> woken = waits->wait(std::chrono::nanoseconds{left}); !woken) return woken.status();
  }
  return {};
}

}  // namespace

class InstrumentStream::Impl {
 public:
  Impl(transport::Writer<bleed_v1_Instrument> to, const bleed_v1_Instrument& start) : writer{std::move(to)}, sample{start} {}

  transport::Writer<bleed_v1_Instrument> writer;
  bleed_v1_Instrument sample;
};

InstrumentStream::InstrumentStream(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
InstrumentStream::InstrumentStream(InstrumentStream&&) noexcept = default;
InstrumentStream& InstrumentStream::operator=(InstrumentStream&&) noexcept = default;
InstrumentStream::~InstrumentStream() = default;

Status InstrumentStream::send(const InstrumentSample& from) {
  bleed_v1_Instrument& sample = impl_->sample;
  ++sample.seq;
  sample.stamp_ns = transport::monotonicNow();
  sample.position = wireVec3(from.position);
  sample.orientation = {from.orientation[0], from.orientation[1], from.orientation[2], from.orientation[3]};
  sample.tip_radius_m = from.tip_radius_m;
  sample.force = wireVec3(from.force);
  return impl_->writer.write(sample);
}

std::uint64_t InstrumentStream::lastSeq() const { return impl_->sample.seq; }

Result<InstrumentStream> Session::instrument(std::uint32_t tool, const std::string& name) {
  bleed_v1_Instrument start{};
  if (const Status printable = checkPrintable(name); !printable) {
    return Status{StatusCode::invalid_argument, fmt::format("the name of a tool: {}", printable.message())};
  }
  if (!copyText(name, start.name)) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the name of a tool has {} bytes: at most 32 are possible", name.size())};
  }
  start.tool = tool;
  transport::copyUuid(impl_->client, start.client);
  auto writer = transport::Writer<bleed_v1_Instrument>::create(impl_->participant, impl_->name);
  if (!writer) return writer.status();
  if (Status matched = waitForReader(impl_->participant, *writer, impl_->name); !matched) return matched;
  return InstrumentStream{std::make_unique<InstrumentStream::Impl>(std::move(*writer), start)};
}

}  // namespace bleedsim::client
