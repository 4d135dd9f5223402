// Arguments and answers of commands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bleedsim/types.h"

namespace bleedsim::client {

enum class WoundShape { disc, ellipse, polygon, polyline };

/// A bleeding patch on the tissue.
struct WoundSpec {
  std::string name{};          ///< at most 64 bytes
  Vec3 position{};             ///< m, coordinates of -10 to 10, in the domain
  Vec3 normal{0.0, 0.0, 1.0};  ///< outward, of any length
  Vec3 tangent{};              ///< u axis of the outline; 0 0 0: chosen by the service
  WoundShape shape = WoundShape::disc;
  double radius_m = 0.0;                  ///< disc; ellipse along the tangent; lengths are 1e-5 to 0.1 m
  double radius2_m = 0.0;                 ///< ellipse across the tangent
  double width_m = 0.0;                   ///< polyline
  std::vector<double> outline{};          ///< polygon, polyline: (u, v) pairs in m, -0.1 to 0.1, at most 256 pairs
  double flow_ml_per_s = 0.0;             ///< 0 to 1000; used unless `pressure_mmhg` is set
  std::optional<double> pressure_mmhg{};  ///< 0 to 1000, drives the flow through the orifice law
  double discharge_coefficient = 0.0;     ///< 0.1 to 1; 0: the service's default
};

/// What of a wound changes; unset parts stay.
struct WoundChange {
  std::optional<Vec3> position{};
  std::optional<Vec3> normal{};
  std::optional<double> radius_m{};  ///< becomes a disc
  std::optional<double> flow_ml_per_s{};
  std::optional<double> pressure_mmhg{};
  std::optional<std::string> name{};
};

struct ForceSpec {
  Vec3 position{};          ///< m, coordinates of -10 to 10
  double radius_m = 0.0;    ///< reach, 1e-5 to 10 m; it must touch the domain
  Vec3 newtons{};           ///< total force on the fluid in reach, at most 1e6 N
  double duration_s = 0.1;  ///< simulated seconds
};

struct Pace {
  PaceMode mode = PaceMode::real_time;
  double factor = 1.0;  ///< of PaceMode::factor
};

struct OutputSpec {
  double rate_hz = 0.0;  ///< frames per simulated second, 1 to 1000; 0 keeps the rate
  std::optional<std::vector<std::string>>
      attributes{};  ///< "velocity", "radius", "platelet", "viscosity", "density"; unset keeps them
};

enum class ReplyCode {
  accepted,
  invalid,
  not_found,
  capacity,
  unsupported,
  wrong_state,
  scene,
  busy,
  stale,
  failed,
  leased,     ///< another client holds the lease
  no_answer,  ///< given by the library: the time ran out or the session was closed
  not_sent,   ///< given by the library: refused before sending
};
const char* toString(ReplyCode code);

struct Reply {
  ReplyCode code = ReplyCode::no_answer;
  std::string reason{};
  /// The first step that used the request; of a refusal the coming one. 0 for a reset or a loaded scene: it begins with `epoch`.
  std::uint64_t applied_step = 0;
  double sim_time_s = 0.0;
  std::uint32_t epoch = 0;
  std::uint32_t object_id = 0;  ///< the wound added or touched; 0: none
  std::int64_t client_stamp_ns = 0;
  std::int64_t receive_stamp_ns = 0;
  std::int64_t reply_stamp_ns = 0;
  std::int64_t arrival_stamp_ns = 0;  ///< monotonic clock of this process
  std::string object_name{};          ///< of the checkpoint that was written or restored

  bool accepted() const { return code == ReplyCode::accepted; }
};

/// The service's monotonic clock against ours, from the ping with the shortest round trip.
struct ClockOffset {
  std::int64_t offset_ns = 0;      ///< service minus client
  std::int64_t round_trip_ns = 0;  ///< of that ping, service's own time taken out; the offset is off by half of it at most
  std::uint32_t samples = 0;
};

}  // namespace bleedsim::client
