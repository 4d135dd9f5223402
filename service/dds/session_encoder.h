// The small samples: scene, status, reply and journal.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "idl/bleed.h"
#include "service/dds/journal_entry.h"
#include "service/dds/reply.h"
#include "service/dds/session_report.h"

namespace bleedsim::dds {

class StatusEncoder {
 public:
  explicit StatusEncoder(const SessionIdentity& identity);
  StatusEncoder(const StatusEncoder&) = delete;
  StatusEncoder& operator=(const StatusEncoder&) = delete;

  /// Stamps the sample with the present time and the next heartbeat. Valid until the next call.
  const bleed_v1_Status& encode(const StatusReport& report, std::span<const NamedCount> counts,
                                std::span<const ClientActivity> clients);

  /// Heartbeats given so far.
  std::uint64_t heartbeat() const { return sample_.heartbeat; }

 private:
  void encodeClients(std::span<const ClientActivity> clients);
  void encodeCheckpoints(const std::vector<CheckpointInfo>& checkpoints);

  bleed_v1_Status sample_{};
  std::vector<bleed_v1_Counter> counters_;
  std::array<bleed_v1_ClientActivity, kMaxClients> clients_{};
  std::array<bleed_v1_CheckpointInfo, kMaxCheckpoints> checkpoints_{};
};

class SceneEncoder {
 public:
  explicit SceneEncoder(const SessionIdentity& identity);
  SceneEncoder(const SceneEncoder&) = delete;
  SceneEncoder& operator=(const SceneEncoder&) = delete;

  /// Valid until the next call.
  const bleed_v1_Scene& encode(const SceneReport& report);

 private:
  struct EffectName {
    char text[65];
  };

  template <class Sequence>
  static void lendNames(const std::vector<std::string>& names, std::vector<EffectName>& storage, Sequence& sequence);

  bleed_v1_Scene sample_{};
  std::string text_;
  std::string loaded_text_;
  std::vector<EffectName> effects_;
  std::vector<EffectName> known_effects_;
};

bleed_v1_Reply encodeReply(const Reply& reply);

/// The sample points into `entry`: valid as long as it.
bleed_v1_Journal encodeJournal(const Uuid& session, const JournalEntry& entry);

}  // namespace bleedsim::dds
