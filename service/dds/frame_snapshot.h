// One published state: the particles and everything that frame_stats tells about them. Its buffers are sized once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "service/dds/frame_blocks.h"
#include "service/dds/identity.h"
#include "service/sph/world.h"

namespace bleedsim::dds {

/// Most tools that may push at one time.
inline constexpr std::size_t kMaxInstruments = 64;
/// Most wounds whose ledger is published.
inline constexpr std::size_t kMaxWoundLedgers = 1024;

/// The newest sample of one client that a step has used.
struct InstrumentApplied {
  Uuid client{};
  std::uint64_t seq = 0;
  std::int64_t client_stamp_ns = 0;
  std::uint64_t step = 0;
};

struct FrameSnapshot {
  sph::FrameBuffer frame;
  sph::WorldStats stats;
  std::vector<sph::WoundState> wounds;
  std::array<double, static_cast<std::size_t>(sph::Stage::count)> stage_microseconds{};  ///< mean per step
  std::array<InstrumentApplied, kMaxInstruments> instruments{};
  std::size_t instrument_count = 0;
  std::uint64_t state_hash = 0;
  std::uint64_t journal_number = 0;  ///< entries of the epoch's journal that the state contains
  std::uint32_t epoch = 0;
  std::uint32_t steps_in_frame = 0;
  double real_time_factor = 0.0;
  double behind = 0.0;  ///< wall s
  std::int64_t monotonic_stamp_ns = 0;
  std::int64_t realtime_stamp_ns = 0;

  /// Room for every attribute, so that switching one on allocates nothing.
  void reserve(std::uint32_t capacity) {
    frame.reserve(capacity, allFrameAttributes());
    wounds.reserve(kMaxWoundLedgers);
  }
};

}  // namespace bleedsim::dds
