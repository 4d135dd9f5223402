// Requests as they stand in journal entries, both ways.

#include <fmt/core.h>

#include "service/recording/convert_parts.h"
#include "service/status/wire_bool.h"

namespace bleedsim::recording {
namespace {

void woundToMessage(ToMessage& to, const bleed_v1_Wound& in, Wound& out) {
  to.text("wound.name", in.name, out.mutable_name());
  to.vec3(in.position, out.mutable_position());
  to.vec3(in.normal, out.mutable_normal());
  to.vec3(in.tangent, out.mutable_tangent());
  out.set_shape(in.shape);
  out.set_radius_m(in.radius_m);
  out.set_radius2_m(in.radius2_m);
  out.set_width_m(in.width_m);
  if (to.has("wound.outline", in.outline))
    out.mutable_outline()->Add(in.outline._buffer, in.outline._buffer + in.outline._length);
  out.set_drive(in.drive);
  out.set_flow_ml_per_s(in.flow_ml_per_s);
  out.set_pressure_mmhg(in.pressure_mmhg);
  out.set_discharge_coefficient(in.discharge_coefficient);
}

void woundToSample(ToSample& to, const Wound& in, bleed_v1_Wound& out) {
  constexpr int kMaxOutline = 512;
  to.text("wound.name", in.name(), out.name);
  to.vec3(in.position(), out.position);
  to.vec3(in.normal(), out.normal);
  to.vec3(in.tangent(), out.tangent);
  out.shape = in.shape();
  out.radius_m = in.radius_m();
  out.radius2_m = in.radius2_m();
  out.width_m = in.width_m();
  if (to.reserve("wound.outline", in.outline_size(), kMaxOutline, out.outline)) {
    for (int i = 0; i < in.outline_size(); ++i) out.outline._buffer[i] = in.outline(i);
  }
  out.drive = in.drive();
  out.flow_ml_per_s = in.flow_ml_per_s();
  out.pressure_mmhg = in.pressure_mmhg();
  out.discharge_coefficient = in.discharge_coefficient();
}

}  // namespace

void requestToMessage(ToMessage& to, const bleed_v1_Request& in, Request& out) {
  to.uuid(in.client, out.mutable_client());
  out.set_run(in.run);
  out.set_seq(in.seq);
  const auto& body = in.body._u;
  switch (in.body._d) {
    case bleed_v1_REQUEST_PING:
      out.mutable_ping()->set_client_stamp_ns(body.ping.client_stamp_ns);
      break;
    case bleed_v1_REQUEST_WOUND_ADD:
      woundToMessage(to, body.wound_add, *out.mutable_wound_add());
      break;
    case bleed_v1_REQUEST_WOUND_UPDATE:
      out.mutable_wound_update()->set_wound_id(body.wound_update.wound_id);
      out.mutable_wound_update()->set_fields(body.wound_update.fields);
      woundToMessage(to, body.wound_update.wound, *out.mutable_wound_update()->mutable_wound());
      to.text("wound_update.wound_name", body.wound_update.wound_name, out.mutable_wound_update()->mutable_wound_name());
      break;
    case bleed_v1_REQUEST_WOUND_REMOVE:
      out.mutable_wound_remove()->set_wound_id(body.wound_remove.wound_id);
      to.text("wound_remove.wound_name", body.wound_remove.wound_name, out.mutable_wound_remove()->mutable_wound_name());
      break;
    case bleed_v1_REQUEST_FORCE:
      to.vec3(body.force.position, out.mutable_force()->mutable_position());
      out.mutable_force()->set_radius_m(body.force.radius_m);
      to.vec3(body.force.newtons, out.mutable_force()->mutable_newtons());
      out.mutable_force()->set_duration_s(body.force.duration_s);
      break;
    case bleed_v1_REQUEST_PAUSE:
      out.mutable_pause_session();
      break;
    case bleed_v1_REQUEST_RESUME:
      out.mutable_resume_session();
      break;
    case bleed_v1_REQUEST_RESET:
      out.mutable_reset_session();
      break;
    case bleed_v1_REQUEST_STEP:
      out.mutable_step()->set_count(body.step.count);
      break;
    case bleed_v1_REQUEST_PACE:
      out.mutable_pace()->set_mode(body.pace.mode);
      out.mutable_pace()->set_factor(body.pace.factor);
      break;
    case bleed_v1_REQUEST_OUTPUT:
      out.mutable_output()->set_rate_hz(body.output.rate_hz);
      out.mutable_output()->set_set_attributes(isSet(body.output.set_attributes));
      out.mutable_output()->set_attributes(body.output.attributes);
      break;
    case bleed_v1_REQUEST_LOAD_SCENE:
      to.longText("load_scene.text", body.load_scene.text, out.mutable_load_scene()->mutable_text());
      break;
    case bleed_v1_REQUEST_SHUTDOWN:
      out.mutable_shutdown_session();
      break;
    case bleed_v1_REQUEST_EFFECT:
      to.text("effect.name", body.effect.name, out.mutable_effect()->mutable_name());
      out.mutable_effect()->set_enabled(isSet(body.effect.enabled));
      to.text("effect.settings", body.effect.settings, out.mutable_effect()->mutable_settings());
      break;
    case bleed_v1_REQUEST_ACQUIRE:
      out.mutable_acquire()->set_seconds(body.acquire.seconds);
      break;
    case bleed_v1_REQUEST_RELEASE:
      out.mutable_release();
      break;
    case bleed_v1_REQUEST_CHECKPOINT:
      to.text("save_checkpoint.name", body.save_checkpoint.name, out.mutable_save_checkpoint()->mutable_name());
      break;
    case bleed_v1_REQUEST_RESTORE:
      to.text("restore_checkpoint.name", body.restore_checkpoint.name, out.mutable_restore_checkpoint()->mutable_name());
      break;
    default:
      to.fail(StatusCode::unsupported,
              fmt::format("request kind {} is not known to this version; use a newer client", in.body._d));
  }
}

void requestToSample(ToSample& to, const Request& in, bleed_v1_Request& out) {
  to.uuid("request.client", in.client(), out.client);
  out.run = in.run();
  out.seq = in.seq();
  auto& body = out.body._u;
  switch (in.body_case()) {
    case Request::kPing:
      out.body._d = bleed_v1_REQUEST_PING;
      body.ping.client_stamp_ns = in.ping().client_stamp_ns();
      break;
    case Request::kWoundAdd:
      out.body._d = bleed_v1_REQUEST_WOUND_ADD;
      woundToSample(to, in.wound_add(), body.wound_add);
      break;
    case Request::kWoundUpdate:
      out.body._d = bleed_v1_REQUEST_WOUND_UPDATE;
      body.wound_update.wound_id = in.wound_update().wound_id();
      body.wound_update.fields = in.wound_update().fields();
      woundToSample(to, in.wound_update().wound(), body.wound_update.wound);
      to.text("wound_update.wound_name", in.wound_update().wound_name(), body.wound_update.wound_name);
      break;
    case Request::kWoundRemove:
      out.body._d = bleed_v1_REQUEST_WOUND_REMOVE;
      body.wound_remove.wound_id = in.wound_remove().wound_id();
      to.text("wound_remove.wound_name", in.wound_remove().wound_name(), body.wound_remove.wound_name);
      break;
    case Request::kForce:
      out.body._d = bleed_v1_REQUEST_FORCE;
      to.vec3(in.force().position(), body.force.position);
      body.force.radius_m = in.force().radius_m();
      to.vec3(in.force().newtons(), body.force.newtons);
      body.force.duration_s = in.force().duration_s();
      break;
    case Request::kPauseSession:
      out.body._d = bleed_v1_REQUEST_PAUSE;
      break;
    case Request::kResumeSession:
      out.body._d = bleed_v1_REQUEST_RESUME;
      break;
    case Request::kResetSession:
      out.body._d = bleed_v1_REQUEST_RESET;
      break;
    case Request::kStep:
      out.body._d = bleed_v1_REQUEST_STEP;
      body.step.count = in.step().count();
      break;
    case Request::kPace:
      out.body._d = bleed_v1_REQUEST_PACE;
      body.pace = {in.pace().mode(), in.pace().factor()};
      break;
    case Request::kOutput:
      out.body._d = bleed_v1_REQUEST_OUTPUT;
      body.output = {in.output().rate_hz(), in.output().set_attributes(), in.output().attributes()};
      break;
    case Request::kLoadScene:
      out.body._d = bleed_v1_REQUEST_LOAD_SCENE;
      to.text(in.load_scene().text(), body.load_scene.text);
      break;
    case Request::kShutdownSession:
      out.body._d = bleed_v1_REQUEST_SHUTDOWN;
      break;
    case Request::kEffect:
      out.body._d = bleed_v1_REQUEST_EFFECT;
      to.text("effect.name", in.effect().name(), body.effect.name);
      body.effect.enabled = in.effect().enabled();
      to.text("effect.settings", in.effect().settings(), body.effect.settings);
      break;
    case Request::kAcquire:
      out.body._d = bleed_v1_REQUEST_ACQUIRE;
      body.acquire.seconds = in.acquire().seconds();
      break;
    case Request::kRelease:
      out.body._d = bleed_v1_REQUEST_RELEASE;
      break;
    case Request::kSaveCheckpoint:
      out.body._d = bleed_v1_REQUEST_CHECKPOINT;
      to.text("save_checkpoint.name", in.save_checkpoint().name(), body.save_checkpoint.name);
      break;
    case Request::kRestoreCheckpoint:
      out.body._d = bleed_v1_REQUEST_RESTORE;
      to.text("restore_checkpoint.name", in.restore_checkpoint().name(), body.restore_checkpoint.name);
      break;
    case Request::BODY_NOT_SET:
      to.fail("request.body is missing");
  }
}

}  // namespace bleedsim::recording
