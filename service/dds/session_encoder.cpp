#include "service/dds/session_encoder.h"

#include <algorithm>

#include "service/dds/bounded_text.h"
#include "service/dds/command_limits.h"
#include "service/dds/frame_encoder.h"
#include "service/dds/overloaded.h"
#include "service/status/units.h"
#include "service/transport/clock.h"

namespace bleedsim::dds {
namespace {

constexpr std::size_t kMaxEffects = 64;

bleed_v1_Vec3 toWire(const sph::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

StatusEncoder::StatusEncoder(const SessionIdentity& identity) {
  transport::copyUuid(identity.uuid, sample_.session);
  copyText(identity.name, sample_.session_name);
  copyText(identity.version, sample_.version);
  copyText(identity.host, sample_.host);
  sample_.pid = identity.pid;
  sample_.start_stamp_ns = identity.start_stamp_ns;
  sample_.protocol_minor = bleed_v1_PROTOCOL_MINOR;
  counters_.reserve(kMaxCounters);
}

const bleed_v1_Status& StatusEncoder::encode(const StatusReport& report, std::span<const NamedCount> counts,
                                             std::span<const ClientActivity> clients) {
  sample_.state = static_cast<std::uint32_t>(report.state);
  sample_.epoch = report.epoch;
  sample_.step = report.step;
  sample_.sim_time_s = report.sim_time;
  ++sample_.heartbeat;
  sample_.pace_mode = static_cast<std::uint32_t>(report.pace.mode);
  sample_.pace_factor = report.pace.factor;
  sample_.real_time_factor = report.real_time_factor;
  sample_.behind_s = report.behind;
  sample_.frame_rate_hz = report.frame_rate;
  sample_.particles = report.particles;
  sample_.wounds = report.wounds;
  counters_.clear();
  for (std::size_t i = 0; i < report.faults.size(); ++i) {
    appendCounter(counters_, sph::counterName(static_cast<sph::Counter>(i)), report.faults[i]);
  }
  for (const NamedCount& count : counts) appendCounter(counters_, count.name, count.value);
  const auto length = static_cast<std::uint32_t>(counters_.size());
  sample_.counters = {length, length, counters_.data(), false};
  copyText(shortened(report.text, sizeof sample_.text - 1), sample_.text);
  sample_.monotonic_stamp_ns = transport::monotonicNow();
  sample_.realtime_stamp_ns = transport::realtimeNow();
  encodeClients(clients);
  encodeCheckpoints(report.checkpoints);
  const std::int64_t lease_left = std::max<std::int64_t>(report.lease_until_ns - sample_.monotonic_stamp_ns, 0);
  transport::copyUuid(lease_left > 0 ? report.lease_client : Uuid{}, sample_.lease_client);
  sample_.lease_left_s = static_cast<double>(lease_left) * 1e-9;
  return sample_;
}

void StatusEncoder::encodeClients(std::span<const ClientActivity> clients) {
  const auto count_of = [](const ClientActivity& activity, ClientCount what) {
    return activity.counts[static_cast<std::size_t>(what)];
  };
  const std::size_t count = std::min(clients.size(), clients_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ClientActivity& from = clients[i];
    bleed_v1_ClientActivity& to = clients_[i];
    transport::copyUuid(from.client, to.client);
    to.requests = count_of(from, ClientCount::requests);
    to.refused = count_of(from, ClientCount::refused);
    to.busy = count_of(from, ClientCount::busy);
    to.resent = count_of(from, ClientCount::resent);
    to.instrument_samples = count_of(from, ClientCount::instrument_samples);
    to.instruments_rejected = count_of(from, ClientCount::instruments_rejected);
    to.silent_s = static_cast<double>(std::max<std::int64_t>(sample_.monotonic_stamp_ns - from.last_heard_ns, 0)) * 1e-9;
  }
  const auto length = static_cast<std::uint32_t>(count);
  sample_.clients = {length, length, clients_.data(), false};
}

void StatusEncoder::encodeCheckpoints(const std::vector<CheckpointInfo>& checkpoints) {
  const std::size_t count = std::min(checkpoints.size(), checkpoints_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const CheckpointInfo& from = checkpoints[i];
    bleed_v1_CheckpointInfo& to = checkpoints_[i];
    copyText(from.name, to.name);
    to.epoch = from.epoch;
    to.step = from.step;
    to.sim_time_s = from.sim_time;
    to.bytes = from.bytes;
    to.realtime_stamp_ns = from.realtime_stamp_ns;
    to.own = from.own ? 1 : 0;
  }
  const auto length = static_cast<std::uint32_t>(count);
  sample_.checkpoints = {length, length, checkpoints_.data(), false};
}

SceneEncoder::SceneEncoder(const SessionIdentity& identity) {
  transport::copyUuid(identity.uuid, sample_.session);
  copyText(identity.name, sample_.session_name);
  copyText(identity.version, sample_.version);
  copyText(identity.build_id, sample_.build_id);
  copyText("m", sample_.length_unit);
  copyText("right-handed, +z up", sample_.axes);
  sample_.protocol_major = bleed_v1_PROTOCOL_MAJOR;
  sample_.protocol_minor = bleed_v1_PROTOCOL_MINOR;
}

template <class Sequence>
void SceneEncoder::lendNames(const std::vector<std::string>& names, std::vector<EffectName>& storage, Sequence& sequence) {
  static_assert(sizeof(EffectName) == sizeof(char[65]));
  storage.clear();
  for (const std::string& name : names) {
    if (storage.size() == kMaxEffects) break;
    copyText(name, storage.emplace_back().text);
  }
  const auto count = static_cast<std::uint32_t>(storage.size());
  sequence = {count, count, storage.empty() ? nullptr : &storage.front().text, false};
}

const bleed_v1_Scene& SceneEncoder::encode(const SceneReport& report) {
  sample_.epoch = report.epoch;
  copyText(report.simd_target, sample_.simd_target);
  copyText(report.precision, sample_.precision);
  copyText(report.name, sample_.scene_name);
  text_ = report.text;
  sample_.scene_text = text_.data();
  sample_.seed = report.seed;
  loaded_text_ = report.loaded_text;
  sample_.loaded_text = loaded_text_.data();
  lendNames(report.effects, effects_, sample_.effects);
  lendNames(report.known_effects, known_effects_, sample_.known_effects);
  copyText(report.frame_id, sample_.frame_id);
  sample_.lower_bound = toWire(report.domain.lower);
  sample_.upper_bound = toWire(report.domain.upper);
  sample_.spacing_m = report.spacing;
  sample_.support_radius_m = report.support_radius;
  sample_.particle_volume_ml = mlFromCubicMetres(report.particle_volume);
  sample_.rest_density_kg_per_m3 = report.rest_density;
  sample_.speed_of_sound_m_per_s = report.speed_of_sound;
  sample_.frame_rate_hz = report.frame_rate;
  sample_.capacity = report.capacity;
  return sample_;
}

bleed_v1_Reply encodeReply(const Reply& reply) {
  bleed_v1_Reply out{};
  transport::copyUuid(reply.key.origin.client, out.client);
  out.run = reply.key.origin.run;
  out.seq = reply.key.seq;
  out.code = static_cast<std::uint32_t>(reply.code);
  out.applied_step = reply.applied_step;
  out.sim_time_s = reply.sim_time;
  out.epoch = reply.epoch;
  out.object_id = reply.object_id;
  copyText(shortened(reply.reason, kMaxReasonBytes), out.reason);
  out.client_stamp_ns = reply.client_stamp_ns;
  out.receive_stamp_ns = reply.receive_stamp_ns;
  out.reply_stamp_ns = reply.reply_stamp_ns;
  copyText(reply.object_name, out.object_name);
  return out;
}

bleed_v1_Journal encodeJournal(const Uuid& session, const JournalEntry& entry) {
  bleed_v1_Journal out{};
  transport::copyUuid(session, out.session);
  out.epoch = entry.epoch;
  out.number = entry.number;
  out.step = entry.step;
  out.sim_time_s = entry.sim_time;
  bleed_v1_JournalBody& body = out.body;
  std::visit(Overloaded{[&body](const Decision& decision) {
                          body._d = bleed_v1_JOURNAL_DECISION;
                          copyText(shortened(decision.text, sizeof body._u.decision - 1), body._u.decision);
                        },
                        [&body](const RequestTaken& taken) {
                          body._d = bleed_v1_JOURNAL_REQUEST;
                          body._u.request.request = taken.request->sample();
                          body._u.request.object_id = taken.object_id;
                        },
                        [&body](const InstrumentTaken& taken) {
                          body._d = bleed_v1_JOURNAL_INSTRUMENT;
                          body._u.instrument = taken.sample;
                        },
                        [&body](const InstrumentEnded& ended) {
                          body._d = bleed_v1_JOURNAL_INSTRUMENT_END;
                          transport::copyUuid(ended.key.client, body._u.instrument_end.client);
                          body._u.instrument_end.tool = ended.key.tool;
                          body._u.instrument_end.reason = static_cast<std::uint32_t>(ended.reason);
                        },
                        [&body](const Restored& restored) {
                          body._d = bleed_v1_JOURNAL_RESTORED;
                          bleed_v1_Restored& to = body._u.restored;
                          transport::copyUuid(restored.session, to.session);
                          to.epoch = restored.epoch;
                          to.step = restored.step;
                          to.number = restored.number;
                          to.state_hash = restored.state_hash;
                          copyText(restored.name, to.name);
                        },
                        [&body](const Switched& switched) {
                          body._d = bleed_v1_JOURNAL_SWITCHED;
                          body._u.switched.narrowest_wound_m = switched.narrowest_wound;
                          body._u.switched.by_request = switched.by_request ? 1 : 0;
                        }},
             entry.input);
  return out;
}

}  // namespace bleedsim::dds
