#include "service/recording/convert.h"

#include <fmt/core.h>

#include "service/recording/convert_parts.h"

namespace bleedsim::recording {
namespace {

template <class Sequence, class Repeated>
void counters(ToMessage& to, const char* name, const Sequence& in, Repeated& out) {
  if (!to.has(name, in)) return;
  for (std::uint32_t i = 0; i < in._length; ++i) {
    Counter& counter = *out.Add();
    to.text(name, in._buffer[i].name, counter.mutable_name());
    counter.set_value(in._buffer[i].value);
  }
}

}  // namespace

::bleedsim::Status toRecording(const bleed_v1_Frame& sample, Frame& out) {
  ToMessage to;
  out.Clear();
  to.uuid(sample.session, out.mutable_session());
  out.set_seq(sample.seq);
  out.set_step(sample.step);
  out.set_sim_time_s(sample.sim_time_s);
  out.set_monotonic_stamp_ns(sample.monotonic_stamp_ns);
  out.set_realtime_stamp_ns(sample.realtime_stamp_ns);
  out.set_epoch(sample.epoch);
  out.set_count(sample.count);
  if (to.has("frame.attributes", sample.attributes)) {
    for (std::uint32_t i = 0; i < sample.attributes._length; ++i) {
      const bleed_v1_Attribute& in = sample.attributes._buffer[i];
      Attribute& attribute = *out.add_attributes();
      // Enumerations are open: numbers of a newer version pass through.
      attribute.set_semantic(static_cast<Attribute::Semantic>(in.semantic));
      attribute.set_scalar_type(static_cast<Attribute::ScalarType>(in.scalar_type));
      attribute.set_components(in.components);
      attribute.set_scale(in.scale);
      attribute.set_offset(in.offset);
    }
  }
  if (to.has("frame.payload", sample.payload)) out.set_payload(sample.payload._buffer, sample.payload._length);
  return to.status();
}

::bleedsim::Status toRecording(const bleed_v1_FrameStats& sample, FrameStats& out) {
  ToMessage to;
  out.Clear();
  to.uuid(sample.session, out.mutable_session());
  out.set_seq(sample.seq);
  out.set_epoch(sample.epoch);
  out.set_step(sample.step);
  out.set_sim_time_s(sample.sim_time_s);
  out.set_dt_s(sample.dt_s);
  out.set_steps_in_frame(sample.steps_in_frame);
  out.set_real_time_factor(sample.real_time_factor);
  out.set_behind_s(sample.behind_s);
  if (to.has("frame_stats.stage_costs", sample.stage_costs)) {
    for (std::uint32_t i = 0; i < sample.stage_costs._length; ++i) {
      StageCost& cost = *out.add_stage_costs();
      to.text("frame_stats.stage_costs.name", sample.stage_costs._buffer[i].name, cost.mutable_name());
      cost.set_microseconds(sample.stage_costs._buffer[i].microseconds);
    }
  }
  out.set_mean_density_error(sample.mean_density_error);
  out.set_max_density_error(sample.max_density_error);
  out.set_max_speed_m_per_s(sample.max_speed_m_per_s);
  out.set_kinetic_energy_j(sample.kinetic_energy_j);
  out.set_state_hash(sample.state_hash);
  out.set_particles(sample.particles);
  out.set_injected(sample.injected);
  out.set_removed(sample.removed);
  out.set_emitted_ml(sample.emitted_ml);
  out.set_commanded_ml(sample.commanded_ml);
  if (to.has("frame_stats.wounds", sample.wounds)) {
    for (std::uint32_t i = 0; i < sample.wounds._length; ++i) {
      const bleed_v1_WoundLedger& in = sample.wounds._buffer[i];
      WoundLedger& wound = *out.add_wounds();
      wound.set_wound_id(in.wound_id);
      wound.set_emitted_ml(in.emitted_ml);
      wound.set_flow_ml_per_s(in.flow_ml_per_s);
    }
  }
  counters(to, "frame_stats.fault_counters", sample.fault_counters, *out.mutable_fault_counters());
  out.set_frames_overwritten(sample.frames_overwritten);
  if (to.has("frame_stats.instruments", sample.instruments)) {
    for (std::uint32_t i = 0; i < sample.instruments._length; ++i) {
      const bleed_v1_InstrumentApplied& in = sample.instruments._buffer[i];
      InstrumentApplied& applied = *out.add_instruments();
      to.uuid(in.client, applied.mutable_client());
      applied.set_seq(in.seq);
      applied.set_client_stamp_ns(in.client_stamp_ns);
      applied.set_step(in.step);
    }
  }
  out.set_journal_number(sample.journal_number);
  return to.status();
}

::bleedsim::Status toRecording(const bleed_v1_Status& sample, recording::Status& out) {
  ToMessage to;
  out.Clear();
  to.uuid(sample.session, out.mutable_session());
  to.text("status.session_name", sample.session_name, out.mutable_session_name());
  out.set_state(sample.state);
  out.set_epoch(sample.epoch);
  out.set_step(sample.step);
  out.set_sim_time_s(sample.sim_time_s);
  out.set_heartbeat(sample.heartbeat);
  out.set_pace_mode(sample.pace_mode);
  out.set_pace_factor(sample.pace_factor);
  out.set_real_time_factor(sample.real_time_factor);
  out.set_frame_rate_hz(sample.frame_rate_hz);
  out.set_particles(sample.particles);
  out.set_wounds(sample.wounds);
  counters(to, "status.counters", sample.counters, *out.mutable_counters());
  to.text("status.text", sample.text, out.mutable_text());
  to.text("status.version", sample.version, out.mutable_version());
  out.set_protocol_minor(sample.protocol_minor);
  to.text("status.host", sample.host, out.mutable_host());
  out.set_pid(sample.pid);
  out.set_monotonic_stamp_ns(sample.monotonic_stamp_ns);
  out.set_realtime_stamp_ns(sample.realtime_stamp_ns);
  out.set_start_stamp_ns(sample.start_stamp_ns);
  out.set_behind_s(sample.behind_s);
  if (to.has("status.clients", sample.clients)) {
    for (std::uint32_t i = 0; i < sample.clients._length; ++i) {
      const bleed_v1_ClientActivity& from = sample.clients._buffer[i];
      ClientActivity& client = *out.add_clients();
      to.uuid(from.client, client.mutable_client());
      client.set_requests(from.requests);
      client.set_refused(from.refused);
      client.set_busy(from.busy);
      client.set_resent(from.resent);
      client.set_instrument_samples(from.instrument_samples);
      client.set_instruments_rejected(from.instruments_rejected);
      client.set_silent_s(from.silent_s);
    }
  }
  to.uuid(sample.lease_client, out.mutable_lease_client());
  out.set_lease_left_s(sample.lease_left_s);
  if (to.has("status.checkpoints", sample.checkpoints)) {
    for (std::uint32_t i = 0; i < sample.checkpoints._length; ++i) {
      const bleed_v1_CheckpointInfo& from = sample.checkpoints._buffer[i];
      CheckpointInfo& checkpoint = *out.add_checkpoints();
      to.text("status.checkpoints.name", from.name, checkpoint.mutable_name());
      checkpoint.set_epoch(from.epoch);
      checkpoint.set_step(from.step);
      checkpoint.set_sim_time_s(from.sim_time_s);
      checkpoint.set_bytes(from.bytes);
      checkpoint.set_realtime_stamp_ns(from.realtime_stamp_ns);
      checkpoint.set_own(from.own != 0);
    }
  }
  return to.status();
}

::bleedsim::Status toRecording(const bleed_v1_Scene& sample, Scene& out) {
  ToMessage to;
  out.Clear();
  to.uuid(sample.session, out.mutable_session());
  to.text("scene.session_name", sample.session_name, out.mutable_session_name());
  out.set_epoch(sample.epoch);
  out.set_protocol_major(sample.protocol_major);
  out.set_protocol_minor(sample.protocol_minor);
  to.text("scene.version", sample.version, out.mutable_version());
  to.text("scene.build_id", sample.build_id, out.mutable_build_id());
  to.text("scene.simd_target", sample.simd_target, out.mutable_simd_target());
  to.text("scene.precision", sample.precision, out.mutable_precision());
  to.text("scene.scene_name", sample.scene_name, out.mutable_scene_name());
  to.longText("scene.scene_text", sample.scene_text, out.mutable_scene_text());
  out.set_seed(sample.seed);
  if (to.has("scene.effects", sample.effects)) {
    for (std::uint32_t i = 0; i < sample.effects._length; ++i) {
      to.text("scene.effects", sample.effects._buffer[i], out.add_effects());
    }
  }
  to.text("scene.frame_id", sample.frame_id, out.mutable_frame_id());
  to.text("scene.length_unit", sample.length_unit, out.mutable_length_unit());
  to.text("scene.axes", sample.axes, out.mutable_axes());
  to.vec3(sample.lower_bound, out.mutable_lower_bound());
  to.vec3(sample.upper_bound, out.mutable_upper_bound());
  out.set_spacing_m(sample.spacing_m);
  out.set_support_radius_m(sample.support_radius_m);
  out.set_particle_volume_ml(sample.particle_volume_ml);
  out.set_rest_density_kg_per_m3(sample.rest_density_kg_per_m3);
  out.set_speed_of_sound_m_per_s(sample.speed_of_sound_m_per_s);
  out.set_frame_rate_hz(sample.frame_rate_hz);
  out.set_capacity(sample.capacity);
  if (to.has("scene.known_effects", sample.known_effects)) {
    for (std::uint32_t i = 0; i < sample.known_effects._length; ++i) {
      to.text("scene.known_effects", sample.known_effects._buffer[i], out.add_known_effects());
    }
  }
  to.longText("scene.loaded_text", sample.loaded_text, out.mutable_loaded_text());
  return to.status();
}

::bleedsim::Status toRecording(const bleed_v1_Journal& sample, Journal& out) {
  ToMessage to;
  out.Clear();
  to.uuid(sample.session, out.mutable_session());
  out.set_epoch(sample.epoch);
  out.set_number(sample.number);
  out.set_step(sample.step);
  out.set_sim_time_s(sample.sim_time_s);
  const auto& body = sample.body._u;
  switch (sample.body._d) {
    case bleed_v1_JOURNAL_REQUEST:
      requestToMessage(to, body.request.request, *out.mutable_request()->mutable_request());
      out.mutable_request()->set_object_id(body.request.object_id);
      break;
    case bleed_v1_JOURNAL_INSTRUMENT: {
      const bleed_v1_Instrument& in = body.instrument;
      Instrument& instrument = *out.mutable_instrument();
      to.uuid(in.client, instrument.mutable_client());
      instrument.set_tool(in.tool);
      instrument.set_seq(in.seq);
      instrument.set_stamp_ns(in.stamp_ns);
      to.text("instrument.name", in.name, instrument.mutable_name());
      to.vec3(in.position, instrument.mutable_position());
      instrument.mutable_orientation()->set_x(in.orientation.x);
      instrument.mutable_orientation()->set_y(in.orientation.y);
      instrument.mutable_orientation()->set_z(in.orientation.z);
      instrument.mutable_orientation()->set_w(in.orientation.w);
      instrument.set_tip_radius_m(in.tip_radius_m);
      to.vec3(in.force, instrument.mutable_force());
      break;
    }
    case bleed_v1_JOURNAL_INSTRUMENT_END:
      to.uuid(body.instrument_end.client, out.mutable_instrument_end()->mutable_client());
      out.mutable_instrument_end()->set_tool(body.instrument_end.tool);
      out.mutable_instrument_end()->set_reason(body.instrument_end.reason);
      break;
    case bleed_v1_JOURNAL_DECISION:
      to.text("journal.decision", body.decision, out.mutable_decision());
      break;
    case bleed_v1_JOURNAL_RESTORED: {
      Restored& restored = *out.mutable_restored();
      to.uuid(body.restored.session, restored.mutable_session());
      restored.set_epoch(body.restored.epoch);
      restored.set_step(body.restored.step);
      restored.set_number(body.restored.number);
      restored.set_state_hash(body.restored.state_hash);
      to.text("restored.name", body.restored.name, restored.mutable_name());
      break;
    }
    case bleed_v1_JOURNAL_SWITCHED:
      out.mutable_switched()->set_narrowest_wound_m(body.switched.narrowest_wound_m);
      out.mutable_switched()->set_by_request(body.switched.by_request != 0);
      break;
    default:
      to.fail(StatusCode::unsupported,
              fmt::format("journal entry kind {} is not known to this version; use a newer client", sample.body._d));
  }
  return to.status();
}

}  // namespace bleedsim::recording
