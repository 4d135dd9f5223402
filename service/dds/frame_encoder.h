// A published state becomes the samples of the topics frame and frame_stats. Each encoder owns one sample that it fills again
// and again; it allocates only when a state is larger than any before.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "idl/bleed.h"
#include "service/dds/frame_snapshot.h"
#include "service/dds/session_report.h"

namespace bleedsim::dds {

/// Payload bytes of one particle: position, id and the FrameAttribute bits.
std::size_t frameBytesPerParticle(std::uint32_t attributes);

class FrameEncoder {
 public:
  explicit FrameEncoder(const Uuid& session);
  FrameEncoder(const FrameEncoder&) = delete;
  FrameEncoder& operator=(const FrameEncoder&) = delete;

  /// Payload room for this many particles with every attribute.
  void reserve(std::uint32_t particles);

  /// The sample is valid until the next call.
  const bleed_v1_Frame& encode(const FrameSnapshot& snapshot, std::uint64_t seq);

 private:
  static constexpr std::size_t kMaxAttributes = 5;

  bleed_v1_Frame sample_{};
  std::array<bleed_v1_Attribute, kMaxAttributes> attributes_{};
  std::vector<std::uint8_t> payload_;
};

class FrameStatsEncoder {
 public:
  explicit FrameStatsEncoder(const Uuid& session);
  FrameStatsEncoder(const FrameStatsEncoder&) = delete;
  FrameStatsEncoder& operator=(const FrameStatsEncoder&) = delete;

  /// `service_counts` follow the solver's counters; 64 counters fit in all. The sample is valid until the next call.
  const bleed_v1_FrameStats& encode(const FrameSnapshot& snapshot, std::uint64_t seq, std::uint64_t frames_overwritten,
                                    std::span<const NamedCount> service_counts);

 private:
  bleed_v1_FrameStats sample_{};
  std::vector<bleed_v1_StageCost> stages_;
  std::vector<bleed_v1_WoundLedger> wounds_;
  std::vector<bleed_v1_Counter> counters_;
  std::vector<bleed_v1_InstrumentApplied> instruments_;
};

/// Most counters in one sample of status or frame_stats.
inline constexpr std::size_t kMaxCounters = 64;

/// Appends name and value; what does not fit is left out.
void appendCounter(std::vector<bleed_v1_Counter>& counters, std::string_view name, std::uint64_t value);

}  // namespace bleedsim::dds
