#include "service/dds/frame_encoder.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "service/dds/bounded_text.h"
#include "service/status/units.h"

namespace bleedsim::dds {

// The payload is little-endian on the wire; the blocks are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::size_t kScalarBytes = 4;

/// Writes one attribute after the other.
class PayloadWriter {
 public:
  PayloadWriter(bleed_v1_Frame& sample, std::uint8_t* payload) : sample_{sample}, payload_{payload} {}

  void append(std::uint32_t semantic, std::uint8_t scalar_type, std::uint8_t components, const void* values) {
    sample_.attributes._buffer[sample_.attributes._length++] = {semantic, scalar_type, components, 1.0F, 0.0F};
    const std::size_t bytes = std::size_t{sample_.count} * components * kScalarBytes;
    if (bytes > 0) std::memcpy(payload_ + written_, values, bytes);
    written_ += bytes;
  }
  std::size_t written() const { return written_; }

 private:
  bleed_v1_Frame& sample_;
  std::uint8_t* payload_;
  std::size_t written_ = 0;
};

/// Lends a vector to a sequence of the sample; the vector stays the owner.
template <class Sequence, class T>
void lend(Sequence& sequence, std::vector<T>& values) {
  sequence._length = static_cast<std::uint32_t>(values.size());
  sequence._maximum = sequence._length;
  sequence._buffer = values.data();
  sequence._release = false;
}

}  // namespace

void appendCounter(std::vector<bleed_v1_Counter>& counters, std::string_view name, std::uint64_t value) {
  if (counters.size() >= kMaxCounters) return;
  copyText(name, counters.emplace_back().name);
  counters.back().value = value;
}

std::size_t frameBytesPerParticle(std::uint32_t attributes) {
  std::size_t components = 3 + 1;  // position, id
  for (const FrameBlock& block : kFrameBlocks) {
    if ((attributes & block.attribute) != 0) components += block.components;
  }
  return components * kScalarBytes;
}

FrameEncoder::FrameEncoder(const Uuid& session) {
  transport::copyUuid(session, sample_.session);
  sample_.attributes = {kMaxAttributes, 0, attributes_.data(), false};
}

void FrameEncoder::reserve(std::uint32_t particles) {
  const std::size_t bytes = std::size_t{particles} * frameBytesPerParticle(allFrameAttributes());
  if (payload_.size() < bytes) payload_.resize(bytes);
}

const bleed_v1_Frame& FrameEncoder::encode(const FrameSnapshot& snapshot, std::uint64_t seq) {
  const sph::FrameBuffer& frame = snapshot.frame;
  reserve(frame.count);
  sample_.seq = seq;
  sample_.step = frame.step;
  sample_.sim_time_s = frame.time;
  sample_.monotonic_stamp_ns = snapshot.monotonic_stamp_ns;
  sample_.realtime_stamp_ns = snapshot.realtime_stamp_ns;
  sample_.epoch = snapshot.epoch;
  sample_.count = frame.count;
  sample_.attributes._length = 0;

  PayloadWriter writer{sample_, payload_.data()};
  writer.append(bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, frame.position.data());
  writer.append(bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, frame.id.data());
  for (const FrameBlock& block : kFrameBlocks) {
    if ((frame.attributes & block.attribute) == 0) continue;
    writer.append(block.semantic, bleed_v1_SCALAR_FLOAT32, block.components, (frame.*block.values).data());
  }
  const auto bytes = static_cast<std::uint32_t>(writer.written());
  sample_.payload = {bytes, bytes, payload_.data(), false};
  return sample_;
}

FrameStatsEncoder::FrameStatsEncoder(const Uuid& session) {
  transport::copyUuid(session, sample_.session);
  stages_.reserve(static_cast<std::size_t>(sph::Stage::count));
  wounds_.reserve(kMaxWoundLedgers);
  counters_.reserve(kMaxCounters);
  instruments_.reserve(kMaxInstruments);
}

const bleed_v1_FrameStats& FrameStatsEncoder::encode(const FrameSnapshot& snapshot, std::uint64_t seq,
                                                     std::uint64_t frames_overwritten,
                                                     std::span<const NamedCount> service_counts) {
  const sph::WorldStats& stats = snapshot.stats;
  sample_.seq = seq;
  sample_.epoch = snapshot.epoch;
  sample_.step = stats.step;
  sample_.sim_time_s = stats.time;
  sample_.dt_s = stats.dt;
  sample_.steps_in_frame = snapshot.steps_in_frame;
  sample_.real_time_factor = snapshot.real_time_factor;
  sample_.behind_s = snapshot.behind;
  sample_.mean_density_error = stats.mean_density_error;
  sample_.max_density_error = stats.max_density_error;
  sample_.max_speed_m_per_s = stats.max_speed;
  sample_.kinetic_energy_j = stats.kinetic_energy;
  sample_.state_hash = snapshot.state_hash;
  sample_.journal_number = snapshot.journal_number;
  sample_.particles = stats.particles;
  sample_.injected = stats.injected;
  sample_.removed = stats.removed;
  sample_.emitted_ml = mlFromCubicMetres(stats.emitted_volume);
  sample_.commanded_ml = mlFromCubicMetres(stats.commanded_volume);
  sample_.frames_overwritten = frames_overwritten;

  stages_.clear();
  for (std::size_t i = 0; i < snapshot.stage_microseconds.size(); ++i) {
    copyText(sph::stageName(static_cast<sph::Stage>(i)), stages_.emplace_back().name);
    stages_.back().microseconds = snapshot.stage_microseconds[i];
  }
  wounds_.clear();
  for (const sph::WoundState& wound : snapshot.wounds) {
    if (wounds_.size() == kMaxWoundLedgers) break;
    wounds_.push_back({wound.id, mlFromCubicMetres(wound.emitted), mlFromCubicMetres(wound.flow)});
  }
  counters_.clear();
  for (std::size_t i = 0; i < stats.counters.size(); ++i) {
    appendCounter(counters_, sph::counterName(static_cast<sph::Counter>(i)), stats.counters[i]);
  }
  for (const NamedCount& count : service_counts) appendCounter(counters_, count.name, count.value);
  instruments_.clear();
  for (std::size_t i = 0; i < std::min(snapshot.instrument_count, kMaxInstruments); ++i) {
    const InstrumentApplied& applied = snapshot.instruments[i];
    bleed_v1_InstrumentApplied& out = instruments_.emplace_back();
    transport::copyUuid(applied.client, out.client);
    out.seq = applied.seq;
    out.client_stamp_ns = applied.client_stamp_ns;
    out.step = applied.step;
  }
  lend(sample_.stage_costs, stages_);
  lend(sample_.wounds, wounds_);
  lend(sample_.fault_counters, counters_);
  lend(sample_.instruments, instruments_);
  return sample_;
}

}  // namespace bleedsim::dds
