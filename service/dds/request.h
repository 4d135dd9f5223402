// A request in the service's own terms: SI units, checked, with one type for each thing that can be asked.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "idl/bleed.h"
#include "service/dds/identity.h"
#include "service/sph/command.h"

namespace bleedsim::dds {

enum class PaceMode : std::uint32_t {
  real_time = bleed_v1_PACE_REAL_TIME,
  factor = bleed_v1_PACE_FACTOR,
  maximum = bleed_v1_PACE_MAXIMUM,
};

/// Simulated seconds per wall second: 1 in real time, `factor` otherwise; meaningless at maximum.
struct Pace {
  PaceMode mode = PaceMode::real_time;
  double factor = 1.0;
};

struct Ping {
  std::int64_t client_stamp_ns = 0;
};
/// The force ends `duration` simulated seconds after it took effect.
struct PushForce {
  sph::Vec3 position = sph::Vec3::Zero();
  double radius = 0.0;                  ///< m
  sph::Vec3 force = sph::Vec3::Zero();  ///< N
  double duration = 0.0;                ///< simulated s
};
struct PauseSession {};
struct ResumeSession {};
struct ResetSession {};
struct StepSession {
  std::uint32_t count = 0;
};
struct SetPace {
  Pace pace;
};
struct SetOutput {
  std::optional<double> frame_rate;         ///< frames per simulated second
  std::optional<std::uint32_t> attributes;  ///< sph::FrameAttribute bits
};
struct LoadScene {
  std::string text;
};
struct ShutdownSession {};
struct SetEffect {
  std::string name;
  bool enabled = false;
  std::string settings;  ///< protobuf text of the effect's message; empty: former ones or defaults
};

struct AcquireLease {
  double seconds = 0.0;  ///< wall s
};
struct ReleaseLease {};
/// Names are those of checkpoint::checkName, or empty: an automatic name, or the newest checkpoint.
struct SaveCheckpoint {
  std::string name;
};
struct RestoreCheckpoint {
  std::string name;
};

using Action = std::variant<Ping, sph::AddWound, sph::UpdateWound, sph::RemoveWound, PushForce, PauseSession, ResumeSession,
                            ResetSession, StepSession, SetPace, SetOutput, LoadScene, ShutdownSession, SetEffect, AcquireLease,
                            ReleaseLease, SaveCheckpoint, RestoreCheckpoint>;

/// A request sample that owns what it points to, for the journal. It leaves out the text of a scene to load, which may be a
/// thousand times as large as anything else there: the scene topic has it.
class RequestCopy {
 public:
  /// `sample` must have passed decodeRequest().
  explicit RequestCopy(const bleed_v1_Request& sample);
  RequestCopy(const RequestCopy&) = delete;
  RequestCopy& operator=(const RequestCopy&) = delete;

  /// Valid as long as this object.
  const bleed_v1_Request& sample() const { return sample_; }

 private:
  bleed_v1_Request sample_;
  std::vector<double> outline_;
  char no_text_[1] = "";
};

/// Everything the service needs to carry out a request and to answer it.
struct DecodedRequest {
  RequestKey key;
  Action action;
  std::string wound_name{};               ///< of the wound to change or close, if it is not named by its id
  std::uint64_t writer = 0;               ///< who sent it: transport::PublicationHandle
  std::uint64_t sender = 0;               ///< whose writer that is: takes turns with the others in the command queue
  std::int64_t receive_stamp_ns = 0;      ///< CLOCK_MONOTONIC
  std::unique_ptr<RequestCopy> original;  ///< for the journal
};

/// One sample of a tool's stream.
struct InstrumentSample {
  InstrumentKey key;
  std::uint64_t seq = 0;
  std::int64_t client_stamp_ns = 0;
  sph::Vec3 position = sph::Vec3::Zero();  ///< m, of the tip
  double radius = 0.0;                     ///< m, of the tip
  sph::Vec3 force = sph::Vec3::Zero();     ///< N, on the fluid
  std::uint64_t writer = 0;                ///< who sent it: transport::PublicationHandle
  std::uint64_t sender = 0;                ///< whose writer that is
  bleed_v1_Instrument original{};          ///< for the journal
};

}  // namespace bleedsim::dds
