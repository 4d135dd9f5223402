#include "clients/lib/request_builder.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <string_view>

#include "clients/lib/wire_text.h"
#include "service/status/checkpoint_name.h"
#include "service/status/printable_text.h"
#include "service/status/quantity_limits.h"
#include "service/status/request_limits.h"

namespace bleedsim::client {
namespace {

constexpr std::size_t kMaxOutline = 2 * kMaxPatchPoints;

bleed_v1_Vec3 wireVec3(const Vec3& v) { return {v[0], v[1], v[2]}; }

RequestPointer make(std::uint32_t request) {
  auto out = std::make_shared<OwnedRequest>();
  out->wire.body._d = request;
  return out;
}

template <std::size_t N>
Status setName(const std::string& name, char (&into)[N]) {
  if (const Status printable = checkPrintable(name); !printable) {
    return {StatusCode::invalid_argument, fmt::format("the name of a wound: {}", printable.message())};
  }
  if (copyText(name, into)) return {};
  return {StatusCode::invalid_argument,
          fmt::format("the name of a wound has {} bytes: at most {} are possible", name.size(), N - 1)};
}

/// Which wound is meant.
template <std::size_t N>
Status nameWound(const std::string& name, char (&into)[N]) {
  if (name.empty()) return {StatusCode::invalid_argument, "the name of the wound is empty: give the name it was opened with"};
  return setName(name, into);
}

template <std::size_t N>
Status setCheckpoint(const std::string& name, char (&into)[N]) {
  static_assert(N == kMaxCheckpointName + 1);
  if (name.empty()) return {};
  if (Status valid = checkCheckpointName(name); !valid) return valid;
  return copyText(name, into) ? Status{} : Status{StatusCode::invalid_argument, "the name of a checkpoint is too long"};
}

}  // namespace

Result<RequestPointer> buildAddWound(const WoundSpec& wound) {
  if (wound.outline.size() > kMaxOutline) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the outline has {} numbers: at most {} are possible", wound.outline.size(), kMaxOutline)};
  }
  RequestPointer out = make(bleed_v1_REQUEST_WOUND_ADD);
  bleed_v1_Wound& wire = out->wire.body._u.wound_add;
  if (Status name = setName(wound.name, wire.name); !name) return name;
  wire.position = wireVec3(wound.position);
  wire.normal = wireVec3(wound.normal);
  wire.tangent = wireVec3(wound.tangent);
  wire.shape = static_cast<std::uint32_t>(wound.shape);
  wire.radius_m = wound.radius_m;
  wire.radius2_m = wound.radius2_m;
  wire.width_m = wound.width_m;
  out->outline = wound.outline;
  wire.outline._buffer = out->outline.data();
  wire.outline._length = wire.outline._maximum = static_cast<std::uint32_t>(out->outline.size());
  wire.drive = wound.pressure_mmhg ? bleed_v1_DRIVE_PRESSURE : bleed_v1_DRIVE_FLOW;
  wire.flow_ml_per_s = wound.flow_ml_per_s;
  wire.pressure_mmhg = wound.pressure_mmhg.value_or(0.0);
  wire.discharge_coefficient = wound.discharge_coefficient;
  return out;
}

Result<RequestPointer> buildUpdateWound(std::uint32_t wound_id, const WoundChange& change) {
  RequestPointer out = make(bleed_v1_REQUEST_WOUND_UPDATE);
  bleed_v1_WoundUpdate& update = out->wire.body._u.wound_update;
  update.wound_id = wound_id;
  if (change.flow_ml_per_s && change.pressure_mmhg) {
    return Status{StatusCode::invalid_argument, "a wound is driven by its flow or by its pressure: give one of them"};
  }
  if (change.position) {
    update.fields |= bleed_v1_WOUND_FIELD_POSITION;
    update.wound.position = wireVec3(*change.position);
  }
  if (change.normal) {
    update.fields |= bleed_v1_WOUND_FIELD_NORMAL;
    update.wound.normal = wireVec3(*change.normal);
  }
  if (change.radius_m) {
    update.fields |= bleed_v1_WOUND_FIELD_SHAPE;
    update.wound.shape = bleed_v1_SHAPE_DISC;
    update.wound.radius_m = *change.radius_m;
  }
  if (change.flow_ml_per_s || change.pressure_mmhg) {
    update.fields |= bleed_v1_WOUND_FIELD_DRIVE;
    update.wound.drive = change.pressure_mmhg ? bleed_v1_DRIVE_PRESSURE : bleed_v1_DRIVE_FLOW;
    update.wound.flow_ml_per_s = change.flow_ml_per_s.value_or(0.0);
    update.wound.pressure_mmhg = change.pressure_mmhg.value_or(0.0);
  }
  if (change.name) {
    update.fields |= bleed_v1_WOUND_FIELD_NAME;
    if (Status name = setName(*change.name, update.wound.name); !name) return name;
  }
  if (update.fields == 0) {
    return Status{StatusCode::invalid_argument,
                  "nothing of the wound is to change: give a position, normal, radius, drive or name"};
  }
  return out;
}

RequestPointer buildRemoveWound(std::uint32_t wound_id) {
  RequestPointer out = make(bleed_v1_REQUEST_WOUND_REMOVE);
  out->wire.body._u.wound_remove.wound_id = wound_id;
  return out;
}

Result<RequestPointer> buildUpdateWound(const std::string& name, const WoundChange& change) {
  Result<RequestPointer> out = buildUpdateWound(0, change);
  if (!out) return out;
  if (Status named = nameWound(name, (*out)->wire.body._u.wound_update.wound_name); !named) return named;
  return out;
}

Result<RequestPointer> buildRemoveWound(const std::string& name) {
  RequestPointer out = buildRemoveWound(0);
  if (Status named = nameWound(name, out->wire.body._u.wound_remove.wound_name); !named) return named;
  return out;
}

RequestPointer buildAcquire(double seconds) {
  RequestPointer out = make(bleed_v1_REQUEST_ACQUIRE);
  out->wire.body._u.acquire.seconds = seconds;
  return out;
}

Result<RequestPointer> buildCheckpoint(const std::string& name) {
  RequestPointer out = make(bleed_v1_REQUEST_CHECKPOINT);
  if (Status named = setCheckpoint(name, out->wire.body._u.save_checkpoint.name); !named) return named;
  return out;
}

Result<RequestPointer> buildRestore(const std::string& name) {
  RequestPointer out = make(bleed_v1_REQUEST_RESTORE);
  if (Status named = setCheckpoint(name, out->wire.body._u.restore_checkpoint.name); !named) return named;
  return out;
}

RequestPointer buildForce(const ForceSpec& force) {
  RequestPointer out = make(bleed_v1_REQUEST_FORCE);
  out->wire.body._u.force = {wireVec3(force.position), force.radius_m, wireVec3(force.newtons), force.duration_s};
  return out;
}

RequestPointer buildStep(std::uint32_t count) {
  RequestPointer out = make(bleed_v1_REQUEST_STEP);
  out->wire.body._u.step.count = count;
  return out;
}

RequestPointer buildPace(const Pace& pace) {
  RequestPointer out = make(bleed_v1_REQUEST_PACE);
  out->wire.body._u.pace = {static_cast<std::uint32_t>(pace.mode), pace.factor};
  return out;
}

Result<RequestPointer> buildOutput(const OutputSpec& output) {
  constexpr std::array<std::string_view, 7> kNames{"position", "id", "velocity", "radius", "platelet", "viscosity", "density"};
  RequestPointer out = make(bleed_v1_REQUEST_OUTPUT);
  bleed_v1_Output& wire = out->wire.body._u.output;
  wire.rate_hz = output.rate_hz;
  wire.set_attributes = output.attributes.has_value();
  if (!output.attributes) return out;
  for (const std::string& name : *output.attributes) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
      return Status{
          StatusCode::invalid_argument,
          fmt::format("attribute '{}' is unknown: use velocity, radius, platelet, viscosity or density", name.substr(0, 32))};
    }
    wire.attributes |= 1U << static_cast<unsigned>(found - kNames.begin());
  }
  return out;
}

Result<RequestPointer> buildLoadScene(const std::string& text) {
  if (text.size() > kMaxSceneBytes || text.find('\0') != std::string::npos) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("this is no scene text ({} bytes): it is text of at most {} bytes without zero bytes", text.size(),
                              kMaxSceneBytes)};
  }
  RequestPointer out = make(bleed_v1_REQUEST_LOAD_SCENE);
  out->text = text;
  out->wire.body._u.load_scene.text = out->text.data();
  return out;
}

Result<RequestPointer> buildEffect(const std::string& name, bool enabled, const std::string& settings) {
  RequestPointer out = make(bleed_v1_REQUEST_EFFECT);
  bleed_v1_Effect& wire = out->wire.body._u.effect;
  if (name.empty() || !copyText(name, wire.name)) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the name of an effect has {} bytes: 1 to {} are possible", name.size(), sizeof wire.name - 1)};
  }
  if (!copyText(settings, wire.settings)) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("the settings have {} bytes: text of at most {} without zero bytes is possible", settings.size(),
                              sizeof wire.settings - 1)};
  }
  wire.enabled = enabled;
  return out;
}

RequestPointer buildPing(std::int64_t stamp_ns) {
  RequestPointer out = make(bleed_v1_REQUEST_PING);
  out->wire.body._u.ping.client_stamp_ns = stamp_ns;
  return out;
}

RequestPointer buildPlain(std::uint32_t request) { return make(request); }

}  // namespace bleedsim::client
