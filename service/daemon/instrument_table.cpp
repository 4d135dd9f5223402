#include "service/daemon/instrument_table.h"

#include <algorithm>

namespace bleedsim::daemon {
namespace {

// Instruments share the space of force keys with forces on request, which count up from 1.
constexpr sph::ForceKey kFirstInstrumentKey = sph::ForceKey{1} << 63U;

static_assert(checkpoint::kMaxTools >= dds::kMaxInstruments);

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

void InstrumentTable::mark(checkpoint::SessionMark& mark) const {
  mark.tool_count = 0;
  mark.next_tool_key = next_key_;
  for (const Tool& tool : tools_) {
    if (!tool.applied) continue;
    mark.tools[mark.tool_count++] = {tool.sample.key.client, tool.sample.key.tool,          tool.force_key,
                                     tool.applied->seq,      tool.applied->client_stamp_ns, tool.applied->step};
  }
}

void InstrumentTable::restore(const checkpoint::SessionMark& mark, TimePoint now) {
  tools_.clear();
  next_key_ = std::max(mark.next_tool_key, kFirstInstrumentKey);
  for (std::size_t i = 0; i < std::min(mark.tool_count, dds::kMaxInstruments); ++i) {
    const checkpoint::Tool& from = mark.tools[i];
    // Of no writer: the next sample of the tool counts as one of a client that started again.
    Tool tool{{}, now, from.force_key, false, dds::InstrumentApplied{from.client, from.seq, from.client_stamp_ns, from.step}};
    tool.sample.key = {from.client, from.tool};
    tool.sample.seq = from.seq;
    tools_.push_back(tool);
  }
}

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
