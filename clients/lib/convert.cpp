#include "clients/lib/convert.h"

#include "clients/lib/wire_text.h"
#include "service/status/session_state_name.h"
#include "service/transport/uuid.h"

namespace bleedsim::client {
namespace {

Vec3 vec3(const bleed_v1_Vec3& v) { return {v.x, v.y, v.z}; }

template <class Sequence>
std::vector<NamedCounter> counters(const Sequence& sequence) {
  std::vector<NamedCounter> out;
  for (const bleed_v1_Counter& c : elements(sequence)) out.emplace_back(textOf(c.name), c.value);
  return out;
}

}  // namespace

static_assert(static_cast<std::uint32_t>(SessionState::loading) == bleed_v1_STATE_LOADING &&
              static_cast<std::uint32_t>(SessionState::stopped) == bleed_v1_STATE_STOPPED);
const char* toString(SessionState state) { return sessionStateName(static_cast<std::uint32_t>(state)); }

std::string toString(const Uuid& uuid) { return transport::toString(uuid); }

const char* toString(ReplyCode code) {
  switch (code) {
    case ReplyCode::accepted:
      return "accepted";
    case ReplyCode::invalid:
      return "invalid";
    case ReplyCode::not_found:
      return "not found";
    case ReplyCode::capacity:
      return "capacity";
    case ReplyCode::unsupported:
      return "unsupported";
    case ReplyCode::wrong_state:
      return "wrong state";
    case ReplyCode::scene:
      return "scene";
    case ReplyCode::busy:
      return "busy";
    case ReplyCode::stale:
      return "stale";
    case ReplyCode::failed:
      return "failed";
    case ReplyCode::leased:
      return "leased";
    case ReplyCode::no_answer:
      return "no answer";
    case ReplyCode::not_sent:
      return "not sent";
  }
  return "failed";
}

SessionStatus fromWire(const bleed_v1_Status& wire) {
  SessionStatus out;
  out.session = transport::toUuid(wire.session);
  out.name = textOf(wire.session_name);
  out.state = wire.state <= bleed_v1_STATE_STOPPED ? static_cast<SessionState>(wire.state) : SessionState::unknown;
  out.epoch = wire.epoch;
  out.step = wire.step;
  out.sim_time_s = wire.sim_time_s;
  out.heartbeat = wire.heartbeat;
  out.pace = wire.pace_mode <= bleed_v1_PACE_MAXIMUM ? static_cast<PaceMode>(wire.pace_mode) : PaceMode::real_time;
  out.pace_factor = wire.pace_factor;
  out.real_time_factor = wire.real_time_factor;
  out.frame_rate_hz = wire.frame_rate_hz;
  out.particles = wire.particles;
  out.wounds = wire.wounds;
  out.counters = counters(wire.counters);
  out.text = textOf(wire.text);
  out.version = textOf(wire.version);
  out.host = textOf(wire.host);
  out.pid = wire.pid;
  out.monotonic_stamp_ns = wire.monotonic_stamp_ns;
  out.realtime_stamp_ns = wire.realtime_stamp_ns;
  out.start_stamp_ns = wire.start_stamp_ns;
  out.behind_s = wire.behind_s;
  for (const bleed_v1_ClientActivity& c : elements(wire.clients)) {
    out.clients.push_back({transport::toUuid(c.client), c.requests, c.refused, c.busy, c.resent, c.instrument_samples,
                           c.instruments_rejected, c.silent_s});
  }
  if (const Uuid holder = transport::toUuid(wire.lease_client); holder != Uuid{}) out.lease_client = holder;
  out.lease_left_s = wire.lease_left_s;
  for (const bleed_v1_CheckpointInfo& c : elements(wire.checkpoints)) {
    out.checkpoints.push_back({textOf(c.name), c.epoch, c.step, c.sim_time_s, c.bytes, c.realtime_stamp_ns, c.own != 0});
  }
  return out;
}

SceneInfo fromWire(const bleed_v1_Scene& wire) {
  SceneInfo out;
  out.session = transport::toUuid(wire.session);
  out.session_name = textOf(wire.session_name);
  out.epoch = wire.epoch;
  out.protocol_major = wire.protocol_major;
  out.protocol_minor = wire.protocol_minor;
  out.version = textOf(wire.version);
  out.build_id = textOf(wire.build_id);
  out.simd_target = textOf(wire.simd_target);
  out.precision = textOf(wire.precision);
  out.name = textOf(wire.scene_name);
  out.text = longTextOf(wire.scene_text);
  out.seed = wire.seed;
  out.loaded_text = longTextOf(wire.loaded_text);
  for (const auto& effect : elements(wire.effects)) out.effects.push_back(textOf(effect));
  for (const auto& effect : elements(wire.known_effects)) out.known_effects.push_back(textOf(effect));
  out.frame_id = textOf(wire.frame_id);
  out.length_unit = textOf(wire.length_unit);
  out.axes = textOf(wire.axes);
  out.lower_bound = vec3(wire.lower_bound);
  out.upper_bound = vec3(wire.upper_bound);
  out.spacing_m = wire.spacing_m;
  out.support_radius_m = wire.support_radius_m;
  out.particle_volume_ml = wire.particle_volume_ml;
  out.rest_density_kg_per_m3 = wire.rest_density_kg_per_m3;
  out.speed_of_sound_m_per_s = wire.speed_of_sound_m_per_s;
  out.frame_rate_hz = wire.frame_rate_hz;
  out.capacity = wire.capacity;
  return out;
}

FrameStats fromWire(const bleed_v1_FrameStats& wire) {
  FrameStats out;
  out.session = transport::toUuid(wire.session);
  out.seq = wire.seq;
  out.epoch = wire.epoch;
  out.step = wire.step;
  out.sim_time_s = wire.sim_time_s;
  out.dt_s = wire.dt_s;
  out.steps_in_frame = wire.steps_in_frame;
  out.real_time_factor = wire.real_time_factor;
  out.behind_s = wire.behind_s;
  for (const bleed_v1_StageCost& c : elements(wire.stage_costs)) out.stage_costs_us.emplace_back(textOf(c.name), c.microseconds);
  out.mean_density_error = wire.mean_density_error;
  out.max_density_error = wire.max_density_error;
  out.max_speed_m_per_s = wire.max_speed_m_per_s;
  out.kinetic_energy_j = wire.kinetic_energy_j;
  out.state_hash = wire.state_hash;
  out.particles = wire.particles;
  out.injected = wire.injected;
  out.removed = wire.removed;
  out.emitted_ml = wire.emitted_ml;
  out.commanded_ml = wire.commanded_ml;
  for (const bleed_v1_WoundLedger& w : elements(wire.wounds)) out.wounds.push_back({w.wound_id, w.emitted_ml, w.flow_ml_per_s});
  out.fault_counters = counters(wire.fault_counters);
  out.frames_overwritten = wire.frames_overwritten;
  for (const bleed_v1_InstrumentApplied& i : elements(wire.instruments)) {
    out.instruments.push_back({transport::toUuid(i.client), i.seq, i.client_stamp_ns, i.step});
  }
  out.journal_number = wire.journal_number;
  return out;
}

Reply fromWire(const bleed_v1_Reply& wire) {
  Reply out;
  out.code = wire.code <= bleed_v1_REPLY_LEASED ? static_cast<ReplyCode>(wire.code) : ReplyCode::failed;
  out.reason = textOf(wire.reason);
  out.applied_step = wire.applied_step;
  out.sim_time_s = wire.sim_time_s;
  out.epoch = wire.epoch;
  out.object_id = wire.object_id;
  out.client_stamp_ns = wire.client_stamp_ns;
  out.receive_stamp_ns = wire.receive_stamp_ns;
  out.reply_stamp_ns = wire.reply_stamp_ns;
  out.object_name = textOf(wire.object_name);
  return out;
}

}  // namespace bleedsim::client
