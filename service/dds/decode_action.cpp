#include <cstring>
#include <fmt/core.h>

#include "service/dds/bounded_text.h"
#include "service/dds/decode.h"
#include "service/dds/frame_blocks.h"
#include "service/dds/value_check.h"
#include "service/sph/world.h"
#include "service/status/checkpoint_name.h"
#include "service/status/wire_bool.h"

namespace bleedsim::dds {
namespace {

template <class T>
Result<Action> asAction(Result<T> decoded) {
  if (!decoded) return decoded.status();
  return Action{std::move(*decoded)};
}

Result<PushForce> decodeForce(const bleed_v1_Force& sample) {
  const Result<sph::Vec3> position = checkVector("force.position", sample.position, kCoordinate);
  if (!position) return position.status();
  if (Status radius = checkNumber("force.radius_m", sample.radius_m, kForceRadius); !radius) return radius;
  const Result<sph::Vec3> newtons = checkLength("force.newtons", sample.newtons, kForce);
  if (!newtons) return newtons.status();
  if (Status duration = checkNumber("force.duration_s", sample.duration_s, kForceDuration); !duration) return duration;
  return PushForce{*position, sample.radius_m, *newtons, sample.duration_s};
}

Result<StepSession> decodeSteps(const bleed_v1_StepCount& sample) {
  if (sample.count >= 1 && sample.count <= kMaxStepCount) return StepSession{sample.count};
  return Status{StatusCode::invalid_argument, fmt::format("step.count is {}: use 1 to {}", sample.count, kMaxStepCount)};
}

Result<SetPace> decodePace(const bleed_v1_Pace& sample) {
  switch (sample.mode) {
    case bleed_v1_PACE_REAL_TIME:
      return SetPace{{PaceMode::real_time, 1.0}};
    case bleed_v1_PACE_MAXIMUM:
      return SetPace{{PaceMode::maximum, 1.0}};
    case bleed_v1_PACE_FACTOR: {
      if (Status factor = checkNumber("pace.factor", sample.factor, kPaceRange); !factor) return factor;
      return SetPace{{PaceMode::factor, sample.factor}};
    }
    default:
      return Status{StatusCode::invalid_argument,
                    fmt::format("pace.mode is {}: use 0 (real time), 1 (factor) or 2 (maximum)", sample.mode)};
  }
}

Result<SetOutput> decodeOutput(const bleed_v1_Output& sample) {
  SetOutput out;
  if (sample.rate_hz != 0.0) {
    if (Status rate = checkNumber("output.rate_hz", sample.rate_hz, kFrameRateRange); !rate) return rate;
    out.frame_rate = sample.rate_hz;
  }
  if (!isSet(sample.set_attributes)) return out;
  std::uint32_t known = 1U << bleed_v1_SEMANTIC_POSITION | 1U << bleed_v1_SEMANTIC_ID;
  std::uint32_t attributes = 0;
  for (const FrameBlock& block : kFrameBlocks) {
    known |= 1U << block.semantic;
    if ((sample.attributes & 1U << block.semantic) != 0) attributes |= block.attribute;
  }
  if (const std::uint32_t unknown = sample.attributes & ~known; unknown != 0) {
    return Status{
        StatusCode::unsupported,
        fmt::format("output.attributes has bits {:#x}, which this version does not publish: use bits of {:#x}", unknown, known)};
  }
  out.attributes = attributes;
  return out;
}

Result<SetEffect> decodeEffect(const bleed_v1_Effect& sample) {
  const std::string_view name = viewText(sample.name);
  const std::string_view settings = viewText(sample.settings);
  if (name.empty()) return Status{StatusCode::invalid_argument, "effect.name is empty: name an effect, e.g. viscosity"};
  if (Status label = checkLabel("effect.name", name); !label) return label;
  return SetEffect{std::string{name}, isSet(sample.enabled), std::string{settings}};
}

Result<LoadScene> decodeLoadScene(const bleed_v1_LoadScene& sample) {
  const std::size_t length = sample.text == nullptr ? 0 : strnlen(sample.text, kMaxSceneBytes + 1);
  if (length >= 1 && length <= kMaxSceneBytes) return LoadScene{std::string{sample.text, length}};
  return Status{StatusCode::invalid_argument,
                length == 0 ? std::string{"load_scene.text is empty: send the text of a scene"}
                            : fmt::format("load_scene.text is longer than {} bytes: send a smaller scene", kMaxSceneBytes)};
}

/// Empty, or a name. The name of a file to be made of it: what it may hold is decided here, once more than anywhere else.
Result<std::string> decodeName(std::string_view name) {
  if (name.empty()) return std::string{};
  if (Status valid = checkCheckpointName(name); !valid) return valid;
  return std::string{name};
}

Result<Action> decodeSave(const bleed_v1_Checkpoint& sample) {
  Result<std::string> name = decodeName(viewText(sample.name));
  if (!name) return name.status();
  if (isAutomaticCheckpoint(*name)) {
    return Status{StatusCode::invalid_argument, "names that begin with 'auto-' are the service's own: use another one"};
  }
  return Action{SaveCheckpoint{std::move(*name)}};
}

Result<Action> decodeRestore(const bleed_v1_Checkpoint& sample) {
  Result<std::string> name = decodeName(viewText(sample.name));
  if (!name) return name.status();
  return Action{RestoreCheckpoint{std::move(*name)}};
}

}  // namespace

RequestKey requestKey(const bleed_v1_Request& sample) { return {{transport::toUuid(sample.client), sample.run}, sample.seq}; }

Result<Action> decodeAction(const bleed_v1_RequestBody& body) {
  switch (body._d) {
    case bleed_v1_REQUEST_PING:
      return Action{Ping{body._u.ping.client_stamp_ns}};
    case bleed_v1_REQUEST_WOUND_ADD: {
      Result<sph::WoundDescription> wound = decodeWound(body._u.wound_add);
      if (!wound) return wound.status();
      return Action{sph::AddWound{std::move(*wound)}};
    }
    case bleed_v1_REQUEST_WOUND_UPDATE:
      return asAction(decodeWoundUpdate(body._u.wound_update));
    case bleed_v1_REQUEST_WOUND_REMOVE:
      return Action{sph::RemoveWound{body._u.wound_remove.wound_id}};
    case bleed_v1_REQUEST_FORCE:
      return asAction(decodeForce(body._u.force));
    case bleed_v1_REQUEST_PAUSE:
      return Action{PauseSession{}};
    case bleed_v1_REQUEST_RESUME:
      return Action{ResumeSession{}};
    case bleed_v1_REQUEST_RESET:
      return Action{ResetSession{}};
    case bleed_v1_REQUEST_STEP:
      return asAction(decodeSteps(body._u.step));
    case bleed_v1_REQUEST_PACE:
      return asAction(decodePace(body._u.pace));
    case bleed_v1_REQUEST_OUTPUT:
      return asAction(decodeOutput(body._u.output));
    case bleed_v1_REQUEST_LOAD_SCENE:
      return asAction(decodeLoadScene(body._u.load_scene));
    case bleed_v1_REQUEST_SHUTDOWN:
      return Action{ShutdownSession{}};
    case bleed_v1_REQUEST_EFFECT:
      return asAction(decodeEffect(body._u.effect));
    case bleed_v1_REQUEST_ACQUIRE: {
      const double seconds = body._u.acquire.seconds;
      if (Status range = checkNumber("acquire.seconds", seconds, kLeaseRange); !range) return range;
      return Action{AcquireLease{seconds}};
    }
    case bleed_v1_REQUEST_RELEASE:
      return Action{ReleaseLease{}};
    case bleed_v1_REQUEST_CHECKPOINT:
      return decodeSave(body._u.save_checkpoint);
    case bleed_v1_REQUEST_RESTORE:
      return decodeRestore(body._u.restore_checkpoint);
    default:
      return Status{StatusCode::unsupported,
                    fmt::format("request {} is not known to protocol {}.{}: use a newer bleedd or an older client", body._d,
                                bleed_v1_PROTOCOL_MAJOR, bleed_v1_PROTOCOL_MINOR)};
  }
}

}  // namespace bleedsim::dds
