// One frame of particles, checked and unpacked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bleedsim/types.h"

namespace bleedsim::client {

/// What a frame may hold for each particle. Positions and ids are always there.
enum class Attribute { position, id, velocity, radius, platelet, viscosity, density };

struct FrameHeader {
  Uuid session{};
  std::uint64_t seq = 0;  ///< rises by one per published frame
  std::uint64_t step = 0;
  double sim_time_s = 0.0;
  std::int64_t monotonic_stamp_ns = 0;
  std::int64_t realtime_stamp_ns = 0;
  std::uint32_t epoch = 0;
  std::uint32_t count = 0;  ///< particles
};

/// All spans have `header().count` entries, times three for vectors (x0 y0 z0 x1 ...); absent attributes are empty.
class Frame {
 public:
  const FrameHeader& header() const { return header_; }
  std::uint32_t count() const { return header_.count; }

  std::span<const float> positions() const { return positions_; }      ///< 3 x, m
  std::span<const std::uint32_t> ids() const { return ids_; }          ///< stable over a particle's life
  std::span<const float> velocities() const { return velocities_; }    ///< 3 x, m/s
  std::span<const float> radii() const { return radii_; }              ///< m
  std::span<const float> platelets() const { return platelets_; }      ///< 0..1
  std::span<const float> viscosities() const { return viscosities_; }  ///< Pa s
  std::span<const float> densities() const { return densities_; }      ///< kg/m^3

 private:
  friend class FrameDecoder;

  FrameHeader header_;
  std::vector<float> positions_;
  std::vector<std::uint32_t> ids_;
  std::vector<float> velocities_;
  std::vector<float> radii_;
  std::vector<float> platelets_;
  std::vector<float> viscosities_;
  std::vector<float> densities_;
};

/// Frames received and what was lost on the way.
struct FrameCounters {
  std::uint64_t received = 0;   ///< well-formed frames
  std::uint64_t gaps = 0;       ///< frames missing between received ones, by their seq
  std::uint64_t overdue = 0;    ///< later frames that the statistics tell of and that have not come: lost, or still on their way
  std::uint64_t dropped = 0;    ///< received, then overwritten by newer ones before anyone took them
  std::uint64_t malformed = 0;  ///< refused: lengths or values that contradict each other
};

}  // namespace bleedsim::client
