// What the session tells about itself on the scene and status topics.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "idl/bleed.h"
#include "service/dds/request.h"
#include "service/sph/world.h"

namespace bleedsim::dds {

struct SessionIdentity {
  Uuid uuid{};  ///< drawn at each start
  std::string name;
  std::string version;
  std::string build_id;
  std::string host;
  std::int32_t pid = 0;
  std::int64_t start_stamp_ns = 0;  ///< CLOCK_REALTIME
};

enum class SessionState : std::uint32_t {
  loading = bleed_v1_STATE_LOADING,
  running = bleed_v1_STATE_RUNNING,
  paused = bleed_v1_STATE_PAUSED,
  faulted = bleed_v1_STATE_FAULTED,
  stopped = bleed_v1_STATE_STOPPED,
};

struct NamedCount {
  std::string_view name;
  std::uint64_t value = 0;
};

inline constexpr std::size_t kMaxClients = 32;  ///< on the status topic

enum class ClientCount { requests, refused, busy, resent, instrument_samples, instruments_rejected, count };

/// What one client has sent; the fields of bleed_v1_ClientActivity.
struct ClientActivity {
  Uuid client{};
  std::array<std::uint64_t, static_cast<std::size_t>(ClientCount::count)> counts{};
  std::int64_t last_heard_ns = 0;  ///< CLOCK_MONOTONIC
};

inline constexpr std::size_t kMaxCheckpoints = 32;  ///< on the status topic

/// A state that the session can return to; the fields of bleed_v1_CheckpointInfo.
struct CheckpointInfo {
  std::string name;
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double sim_time = 0.0;  ///< s
  std::uint64_t bytes = 0;
  std::int64_t realtime_stamp_ns = 0;
  bool own = false;  ///< of this session
};

struct StatusReport {
  SessionState state = SessionState::loading;
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double sim_time = 0.0;  ///< s
  Pace pace;
  double real_time_factor = 0.0;
  double behind = 0.0;      ///< wall s owed by the pacing
  double frame_rate = 0.0;  ///< frames per simulated second
  std::uint32_t particles = 0;
  std::uint32_t wounds = 0;
  std::string text;
  /// The solver's, as of the last frame, by sph::Counter.
  std::array<std::uint64_t, static_cast<std::size_t>(sph::Counter::count)> faults{};
  std::size_t full_frame_bytes = 0;         ///< payload of a frame at capacity; not published
  Uuid lease_client{};                      ///< of the lease that lasts until lease_until_ns
  std::int64_t lease_until_ns = 0;          ///< CLOCK_MONOTONIC
  std::vector<CheckpointInfo> checkpoints;  ///< the newest first
};

/// What late joiners need to read frames. One per epoch and switched effect.
struct SceneReport {
  std::uint32_t epoch = 0;
  std::string simd_target;
  std::string precision;
  std::string name;
  std::string text;         ///< normalised, of what acts now
  std::string loaded_text;  ///< the same as the epoch began with it
  std::uint64_t seed = 0;
  std::vector<std::string> effects;
  std::vector<std::string> known_effects;
  std::string frame_id;
  sph::Domain domain;
  double spacing = 0.0;          ///< m
  double support_radius = 0.0;   ///< m
  double particle_volume = 0.0;  ///< m^3
  double rest_density = 0.0;     ///< kg/m^3
  double speed_of_sound = 0.0;   ///< m/s
  double frame_rate = 0.0;       ///< frames per simulated second
  std::uint32_t capacity = 0;
};

}  // namespace bleedsim::dds
