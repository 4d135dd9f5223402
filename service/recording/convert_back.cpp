// Messages of a recording -> samples, owned by the caller.

#include <cstring>
#include <dds/dds.h>
#include <fmt/core.h>
#include <limits>

#include "service/recording/convert.h"
#include "service/recording/convert_parts.h"

namespace bleedsim::recording {
namespace {

constexpr int kMaxAttributes = 16;
constexpr int kMaxStages = 32;
constexpr int kMaxWounds = 1024;
constexpr int kMaxCounters = 64;
constexpr int kMaxInstruments = 64;
constexpr int kMaxEffects = 64;
constexpr int kMaxClients = 32;
constexpr int kMaxCheckpoints = 32;

template <class T>
SamplePtr<T> makeSample() {
  auto* memory = static_cast<T*>(dds_alloc(sizeof(T)));
  std::memset(memory, 0, sizeof(T));
  return SamplePtr<T>{memory};
}

template <class T>
Result<SamplePtr<T>> finish(const ToSample& to, SamplePtr<T> sample) {
  if (!to.status().ok()) return to.status();
  return sample;
}

template <class Repeated, class Sequence>
void counters(ToSample& to, const char* name, const Repeated& in, Sequence& out) {
  if (!to.reserve(name, in.size(), kMaxCounters, out)) return;
  for (int i = 0; i < in.size(); ++i) {
    to.text(name, in[i].name(), out._buffer[i].name);
    out._buffer[i].value = in[i].value();
  }
}

template <class Repeated, class Sequence>
void effectNames(ToSample& to, const char* name, const Repeated& in, Sequence& out) {
  if (!to.reserve(name, in.size(), kMaxEffects, out)) return;
  for (int i = 0; i < in.size(); ++i) to.text(name, in[i], out._buffer[i]);
}

std::uint8_t octet(ToSample& to, const char* name, std::uint32_t value) {
  if (value > std::numeric_limits<std::uint8_t>::max()) to.fail(fmt::format("{} is {}, more than 255", name, value));
  return static_cast<std::uint8_t>(value);
}

}  // namespace

void SampleDelete::operator()(bleed_v1_Frame* sample) const { dds_sample_free(sample, &bleed_v1_Frame_desc, DDS_FREE_ALL); }
void SampleDelete::operator()(bleed_v1_FrameStats* sample) const {
  dds_sample_free(sample, &bleed_v1_FrameStats_desc, DDS_FREE_ALL);
}
void SampleDelete::operator()(bleed_v1_Status* sample) const { dds_sample_free(sample, &bleed_v1_Status_desc, DDS_FREE_ALL); }
void SampleDelete::operator()(bleed_v1_Scene* sample) const { dds_sample_free(sample, &bleed_v1_Scene_desc, DDS_FREE_ALL); }
void SampleDelete::operator()(bleed_v1_Journal* sample) const { dds_sample_free(sample, &bleed_v1_Journal_desc, DDS_FREE_ALL); }

Result<SamplePtr<bleed_v1_Frame>> fromRecording(const Frame& message) {
  ToSample to;
  auto out = makeSample<bleed_v1_Frame>();
  to.uuid("frame.session", message.session(), out->session);
  out->seq = message.seq();
  out->step = message.step();
  out->sim_time_s = message.sim_time_s();
  out->monotonic_stamp_ns = message.monotonic_stamp_ns();
  out->realtime_stamp_ns = message.realtime_stamp_ns();
  out->epoch = message.epoch();
  out->count = message.count();
  if (to.reserve("frame.attributes", message.attributes_size(), kMaxAttributes, out->attributes)) {
    for (int i = 0; i < message.attributes_size(); ++i) {
      const Attribute& in = message.attributes(i);
      bleed_v1_Attribute& attribute = out->attributes._buffer[i];
      attribute.semantic = static_cast<std::uint32_t>(in.semantic());
      attribute.scalar_type = octet(to, "frame.attributes.scalar_type", static_cast<std::uint32_t>(in.scalar_type()));
      attribute.components = octet(to, "frame.attributes.components", in.components());
      attribute.scale = in.scale();
      attribute.offset = in.offset();
    }
  }
  if (to.allocate(message.payload().size(), out->payload)) {
    std::memcpy(out->payload._buffer, message.payload().data(), message.payload().size());
  }
  return finish(to, std::move(out));
}

Result<SamplePtr<bleed_v1_FrameStats>> fromRecording(const FrameStats& message) {
  ToSample to;
  auto out = makeSample<bleed_v1_FrameStats>();
  to.uuid("frame_stats.session", message.session(), out->session);
  out->seq = message.seq();
  out->epoch = message.epoch();
  out->step = message.step();
  out->sim_time_s = message.sim_time_s();
  out->dt_s = message.dt_s();
  out->steps_in_frame = message.steps_in_frame();
  out->real_time_factor = message.real_time_factor();
  out->behind_s = message.behind_s();
  if (to.reserve("frame_stats.stage_costs", message.stage_costs_size(), kMaxStages, out->stage_costs)) {
    for (int i = 0; i < message.stage_costs_size(); ++i) {
      to.text("frame_stats.stage_costs.name", message.stage_costs(i).name(), out->stage_costs._buffer[i].name);
      out->stage_costs._buffer[i].microseconds = message.stage_costs(i).microseconds();
    }
  }
  out->mean_density_error = message.mean_density_error();
  out->max_density_error = message.max_density_error();
  out->max_speed_m_per_s = message.max_speed_m_per_s();
  out->kinetic_energy_j = message.kinetic_energy_j();
  out->state_hash = message.state_hash();
  out->particles = message.particles();
  out->injected = message.injected();
  out->removed = message.removed();
  out->emitted_ml = message.emitted_ml();
  out->commanded_ml = message.commanded_ml();
  if (to.reserve("frame_stats.wounds", message.wounds_size(), kMaxWounds, out->wounds)) {
    for (int i = 0; i < message.wounds_size(); ++i) {
      const WoundLedger& in = message.wounds(i);
      out->wounds._buffer[i] = {in.wound_id(), in.emitted_ml(), in.flow_ml_per_s()};
    }
  }
  counters(to, "frame_stats.fault_counters", message.fault_counters(), out->fault_counters);
  out->frames_overwritten = message.frames_overwritten();
  if (to.reserve("frame_stats.instruments", message.instruments_size(), kMaxInstruments, out->instruments)) {
    for (int i = 0; i < message.instruments_size(); ++i) {
      const InstrumentApplied& in = message.instruments(i);
      bleed_v1_InstrumentApplied& applied = out->instruments._buffer[i];
      to.uuid("frame_stats.instruments.client", in.client(), applied.client);
      applied.seq = in.seq();
      applied.client_stamp_ns = in.client_stamp_ns();
      applied.step = in.step();
    }
  }
  out->journal_number = message.journal_number();
  return finish(to, std::move(out));
}

Result<SamplePtr<bleed_v1_Status>> fromRecording(const recording::Status& message) {
  ToSample to;
  auto out = makeSample<bleed_v1_Status>();
  to.uuid("status.session", message.session(), out->session);
  to.text("status.session_name", message.session_name(), out->session_name);
  out->state = message.state();
  out->epoch = message.epoch();
  out->step = message.step();
  out->sim_time_s = message.sim_time_s();
  out->heartbeat = message.heartbeat();
  out->pace_mode = message.pace_mode();
  out->pace_factor = message.pace_factor();
  out->real_time_factor = message.real_time_factor();
  out->frame_rate_hz = message.frame_rate_hz();
  out->particles = message.particles();
  out->wounds = message.wounds();
  counters(to, "status.counters", message.counters(), out->counters);
  to.text("status.text", message.text(), out->text);
  to.text("status.version", message.version(), out->version);
  out->protocol_minor = message.protocol_minor();
  to.text("status.host", message.host(), out->host);
  out->pid = message.pid();
  out->monotonic_stamp_ns = message.monotonic_stamp_ns();
  out->realtime_stamp_ns = message.realtime_stamp_ns();
  out->start_stamp_ns = message.start_stamp_ns();
  out->behind_s = message.behind_s();
  if (to.reserve("status.clients", message.clients_size(), kMaxClients, out->clients)) {
    for (int i = 0; i < message.clients_size(); ++i) {
      const ClientActivity& from = message.clients(i);
      bleed_v1_ClientActivity& client = out->clients._buffer[i];
      to.uuid("status.clients.client", from.client(), client.client);
      client.requests = from.requests();
      client.refused = from.refused();
      client.busy = from.busy();
      client.resent = from.resent();
      client.instrument_samples = from.instrument_samples();
      client.instruments_rejected = from.instruments_rejected();
      client.silent_s = from.silent_s();
    }
  }
  // Recordings of before protocol 1.2 have none.
  if (!message.lease_client().empty()) to.uuid("status.lease_client", message.lease_client(), out->lease_client);
  out->lease_left_s = message.lease_left_s();
  if (to.reserve("status.checkpoints", message.checkpoints_size(), kMaxCheckpoints, out->checkpoints)) {
    for (int i = 0; i < message.checkpoints_size(); ++i) {
      const CheckpointInfo& from = message.checkpoints(i);
      bleed_v1_CheckpointInfo& checkpoint = out->checkpoints._buffer[i];
      to.text("status.checkpoints.name", from.name(), checkpoint.name);
      checkpoint.epoch = from.epoch();
      checkpoint.step = from.step();
      checkpoint.sim_time_s = from.sim_time_s();
      checkpoint.bytes = from.bytes();
      checkpoint.realtime_stamp_ns = from.realtime_stamp_ns();
      checkpoint.own = from.own() ? 1 : 0;
    }
  }
  return finish(to, std::move(out));
}

Result<SamplePtr<bleed_v1_Scene>> fromRecording(const Scene& message) {
  ToSample to;
  auto out = makeSample<bleed_v1_Scene>();
  to.uuid("scene.session", message.session(), out->session);
  to.text("scene.session_name", message.session_name(), out->session_name);
  out->epoch = message.epoch();
  out->protocol_major = message.protocol_major();
  out->protocol_minor = message.protocol_minor();
  to.text("scene.version", message.version(), out->version);
  to.text("scene.build_id", message.build_id(), out->build_id);
  to.text("scene.simd_target", message.simd_target(), out->simd_target);
  to.text("scene.precision", message.precision(), out->precision);
  to.text("scene.scene_name", message.scene_name(), out->scene_name);
  to.text(message.scene_text(), out->scene_text);
  out->seed = message.seed();
  effectNames(to, "scene.effects", message.effects(), out->effects);
  to.text("scene.frame_id", message.frame_id(), out->frame_id);
  to.text("scene.length_unit", message.length_unit(), out->length_unit);
  to.text("scene.axes", message.axes(), out->axes);
  to.vec3(message.lower_bound(), out->lower_bound);
  to.vec3(message.upper_bound(), out->upper_bound);
  out->spacing_m = message.spacing_m();
  out->support_radius_m = message.support_radius_m();
  out->particle_volume_ml = message.particle_volume_ml();
  out->rest_density_kg_per_m3 = message.rest_density_kg_per_m3();
  out->speed_of_sound_m_per_s = message.speed_of_sound_m_per_s();
  out->frame_rate_hz = message.frame_rate_hz();
  out->capacity = message.capacity();
  effectNames(to, "scene.known_effects", message.known_effects(), out->known_effects);
  to.text(message.loaded_text(), out->loaded_text);
  return finish(to, std::move(out));
}

Result<SamplePtr<bleed_v1_Journal>> fromRecording(const Journal& message) {
  ToSample to;
  auto out = makeSample<bleed_v1_Journal>();
  to.uuid("journal.session", message.session(), out->session);
  out->epoch = message.epoch();
  out->number = message.number();
  out->step = message.step();
  out->sim_time_s = message.sim_time_s();
  auto& body = out->body._u;
  switch (message.body_case()) {
    case Journal::kRequest:
      out->body._d = bleed_v1_JOURNAL_REQUEST;
      requestToSample(to, message.request().request(), body.request.request);
      body.request.object_id = message.request().object_id();
      break;
    case Journal::kInstrument: {
      out->body._d = bleed_v1_JOURNAL_INSTRUMENT;
      const Instrument& in = message.instrument();
      to.uuid("instrument.client", in.client(), body.instrument.client);
      body.instrument.tool = in.tool();
      body.instrument.seq = in.seq();
      body.instrument.stamp_ns = in.stamp_ns();
      to.text("instrument.name", in.name(), body.instrument.name);
      to.vec3(in.position(), body.instrument.position);
      const Quaternion& turn = in.orientation();
      body.instrument.orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
      body.instrument.tip_radius_m = in.tip_radius_m();
      to.vec3(in.force(), body.instrument.force);
      break;
    }
    case Journal::kInstrumentEnd:
      out->body._d = bleed_v1_JOURNAL_INSTRUMENT_END;
      to.uuid("instrument_end.client", message.instrument_end().client(), body.instrument_end.client);
      body.instrument_end.tool = message.instrument_end().tool();
      body.instrument_end.reason = message.instrument_end().reason();
      break;
    case Journal::kDecision:
      out->body._d = bleed_v1_JOURNAL_DECISION;
      to.text("journal.decision", message.decision(), body.decision);
      break;
    case Journal::kRestored:
      out->body._d = bleed_v1_JOURNAL_RESTORED;
      to.uuid("restored.session", message.restored().session(), body.restored.session);
      body.restored.epoch = message.restored().epoch();
      body.restored.step = message.restored().step();
      body.restored.number = message.restored().number();
      body.restored.state_hash = message.restored().state_hash();
      to.text("restored.name", message.restored().name(), body.restored.name);
      break;
    case Journal::kSwitched:
      out->body._d = bleed_v1_JOURNAL_SWITCHED;
      body.switched.narrowest_wound_m = message.switched().narrowest_wound_m();
      body.switched.by_request = message.switched().by_request() ? 1 : 0;
      break;
    case Journal::BODY_NOT_SET:
      to.fail("journal.body is missing");
  }
  return finish(to, std::move(out));
}

}  // namespace bleedsim::recording
