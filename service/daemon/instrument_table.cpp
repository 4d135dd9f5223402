#include "service/daemon/instrument_table.h"

#include <algorithm>

namespace bleedsim::daemon {
namespace {

// Instruments share the space of force keys with forces on request, which count up from 1.
constexpr sph::ForceKey kFirstInstrumentKey = sph::ForceKey{1} << 63U;

}  // namespace

InstrumentTable::InstrumentTable() : next_key_{kFirstInstrumentKey} { tools_.reserve(dds::kMaxInstruments); }

InstrumentTable::Update InstrumentTable::update(const InstrumentInput& input, std::uint64_t& missed) {
  const auto known =
      std::find_if(tools_.begin(), tools_.end(), [&input](const Tool& tool) { return tool.sample.key == input.sample.key; });
  if (known == tools_.end()) {
    const auto of_client = static_cast<std::size_t>(std::count_if(
        tools_.begin(), tools_.end(), [&](const Tool& tool) { return tool.sample.key.client == input.sample.key.client; }));
    if (of_client >= dds::kMaxInstruments - tools_.size()) return Update::full;
    tools_.push_back({input.sample, input.received, next_key_++, true, {}});
    return Update::taken;
  }
  // Another writer is a client that started again: its numbers do, too.
  if (known->sample.writer == input.sample.writer) {
    if (input.sample.seq <= known->sample.seq) return Update::not_newer;
    missed += input.sample.seq - known->sample.seq - 1;
  }
  known->sample = input.sample;
  known->received = input.received;
  known->pending = true;
  return Update::taken;
}

void InstrumentTable::remove(std::size_t index) { tools_.erase(tools_.begin() + static_cast<std::ptrdiff_t>(index)); }

std::optional<TimePoint> InstrumentTable::nextExpiry(Clock::duration expiry) const {
  if (tools_.empty()) return {};
  const auto oldest =
      std::min_element(tools_.begin(), tools_.end(), [](const Tool& a, const Tool& b) { return a.received < b.received; });
  return oldest->received + expiry;
}

std::size_t InstrumentTable::report(std::span<dds::InstrumentApplied> out, std::uint64_t step) const {
  std::size_t count = 0;
  for (const Tool& tool : tools_) {
    if (!tool.applied || tool.applied->step > step) continue;
    const auto end = out.begin() + static_cast<std::ptrdiff_t>(count);
    const auto same = std::find_if(out.begin(), end,
                                   [&tool](const dds::InstrumentApplied& other) { return other.client == tool.applied->client; });
    if (same == end) {
      if (count < out.size()) out[count++] = *tool.applied;
    } else if (same->client_stamp_ns < tool.applied->client_stamp_ns) {
      *same = *tool.applied;
    }
  }
  return count;
}

}  // namespace bleedsim::daemon
