// Values of the client library: plain data in SI units unless a name says otherwise. Positions are right-handed in the frame of
// the scene (SceneInfo::frame_id), quaternions are x, y, z, w, stamps are nanoseconds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::client {

using Vec3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;
using Uuid = std::array<std::uint8_t, 16>;

/// 8-4-4-4-12 hexadecimal digits.
std::string toString(const Uuid& uuid);

enum class SessionState { loading, running, paused, faulted, stopped, unknown };
const char* toString(SessionState state);

enum class PaceMode { real_time, factor, maximum };

using NamedCounter = std::pair<std::string, std::uint64_t>;

/// What one client has sent to a session since it was heard of first there.
struct ClientActivity {
  Uuid client{};
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;  ///< answered with anything but accepted
  std::uint64_t busy = 0;     ///< of these, for want of room: it sends faster than it is served
  std::uint64_t resent = 0;   ///< known requests that came again
  std::uint64_t instrument_samples = 0;
  std::uint64_t instruments_rejected = 0;
  double silent_s = 0.0;  ///< wall time since its last sample
};

/// A state that a session can return to, see Session::restore.
struct CheckpointInfo {
  std::string name;
  std::uint32_t epoch = 0;  ///< of the session that it is of
  std::uint64_t step = 0;
  double sim_time_s = 0.0;
  std::uint64_t bytes = 0;
  std::int64_t realtime_stamp_ns = 0;  ///< when it was taken
  bool own = false;                    ///< of this session; else of one of the same name before it
};

/// What a session says of itself, at least twice a second and at every change.
struct SessionStatus {
  Uuid session{};
  std::string name;
  SessionState state = SessionState::unknown;
  std::uint32_t epoch = 0;  ///< rises with each reset, load_scene or restore
  std::uint64_t step = 0;
  double sim_time_s = 0.0;
  std::uint64_t heartbeat = 0;
  PaceMode pace = PaceMode::real_time;
  double pace_factor = 1.0;
  double real_time_factor = 0.0;
  double frame_rate_hz = 0.0;
  std::uint32_t particles = 0;
  std::uint32_t wounds = 0;
  std::vector<NamedCounter> counters;
  std::string text;
  std::string version;
  std::string host;
  std::int32_t pid = 0;
  std::int64_t monotonic_stamp_ns = 0;
  std::int64_t realtime_stamp_ns = 0;
  std::int64_t start_stamp_ns = 0;  ///< CLOCK_REALTIME when the daemon started
  double behind_s = 0.0;            ///< wall time that the pacing owes
  // Nothing from services before protocol 1.2:
  std::vector<ClientActivity> clients;  ///< at most 32, those heard of last
  std::optional<Uuid> lease_client;     ///< the only one that may command now
  double lease_left_s = 0.0;            ///< wall time until the lease expires by itself
  // Nothing from services before protocol 1.3:
  std::vector<CheckpointInfo> checkpoints;  ///< at most 32, the newest first
};

/// The scene that runs; sent at each load, when an effect was switched, and to late joiners.
struct SceneInfo {
  Uuid session{};
  std::string session_name;
  std::uint32_t epoch = 0;
  std::uint32_t protocol_major = 0;
  std::uint32_t protocol_minor = 0;
  std::string version;
  std::string build_id;
  std::string simd_target;
  std::string precision;
  std::string name;
  std::string text;         ///< protobuf text of the scene, as it acts now
  std::string loaded_text;  ///< the same as the epoch began with it; empty from services before protocol 1.1
  std::uint64_t seed = 0;
  std::vector<std::string> effects;        ///< that act
  std::vector<std::string> known_effects;  ///< that the service can switch; empty from services before protocol 1.1
  std::string frame_id;
  std::string length_unit;
  std::string axes;
  Vec3 lower_bound{};
  Vec3 upper_bound{};
  double spacing_m = 0.0;
  double support_radius_m = 0.0;
  double particle_volume_ml = 0.0;
  double rest_density_kg_per_m3 = 0.0;
  double speed_of_sound_m_per_s = 0.0;
  double frame_rate_hz = 0.0;
  std::uint32_t capacity = 0;
};

struct WoundFlow {
  std::uint32_t id = 0;
  double emitted_ml = 0.0;
  double flow_ml_per_s = 0.0;
};

/// The newest instrument sample that a step has used, of one client.
struct AppliedInstrument {
  Uuid client{};
  std::uint64_t seq = 0;
  std::int64_t client_stamp_ns = 0;
  std::uint64_t step = 0;
};

/// Figures of one frame, with the frame's seq.
struct FrameStats {
  Uuid session{};
  std::uint64_t seq = 0;
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double sim_time_s = 0.0;
  double dt_s = 0.0;
  std::uint32_t steps_in_frame = 0;
  double real_time_factor = 0.0;  ///< simulated over wall seconds of the last second
  double behind_s = 0.0;          ///< wall time that the pacing owes
  std::vector<std::pair<std::string, double>> stage_costs_us;
  double mean_density_error = 0.0;
  double max_density_error = 0.0;
  double max_speed_m_per_s = 0.0;
  double kinetic_energy_j = 0.0;
  std::uint64_t state_hash = 0;
  std::uint32_t particles = 0;
  std::uint64_t injected = 0;
  std::uint64_t removed = 0;
  double emitted_ml = 0.0;
  double commanded_ml = 0.0;
  std::vector<WoundFlow> wounds;
  std::vector<NamedCounter> fault_counters;
  std::uint64_t frames_overwritten = 0;
  std::vector<AppliedInstrument> instruments;
  std::uint64_t journal_number = 0;  ///< entries of the journal that the state contains; 0 from services before protocol 1.3
};

}  // namespace bleedsim::client
