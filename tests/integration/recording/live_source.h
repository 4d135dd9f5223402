// A session's outgoing topics without a simulation behind them: what a recorder meets on the wire, every byte known beforehand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "service/transport/uuid.h"
#include "service/transport/writer.h"

namespace bleedsim::recording_test {

/// The samples of a session as plain values, rebuilt at will: sending and checking use the same ones.
struct FrameContent {
  std::uint64_t seq = 0;
  std::uint32_t epoch = 0;
  std::uint32_t count = 0;
  double sim_time_s = 0.0;
  std::vector<std::uint8_t> payload;  ///< positions, ids, velocities
};

/// Frame number `seq`, 60 of them per simulated second. Payload bytes are random, so that floats of every kind occur.
FrameContent frameContent(std::uint64_t seq, std::uint32_t epoch, std::uint32_t count);

/// The journal's entry number `number`, in turn a wound, an instrument sample, its end and a decision.
bleed_v1_Journal journalEntry(const transport::Uuid& session, std::uint32_t epoch, std::uint64_t number);

/// Writes the topics that a recording holds.
class LiveSource {
 public:
  static Result<LiveSource> create(const transport::Participant& participant, const std::string& session);

  const transport::Uuid& session() const { return session_; }
  const std::string& sceneText() const { return scene_text_; }

  Status writeScene(std::uint32_t epoch);
  Status writeStatus(std::uint32_t epoch, std::uint64_t heartbeat);
  /// The frame and its stats.
  Status writeFrame(const FrameContent& content);
  Status writeJournal(std::uint32_t epoch, std::uint64_t number);
  /// Waits until every matched reader has everything.
  Status settle();

  /// Frame readers matched now.
  std::size_t frameReaders() const { return frames_.matchedCount(); }

 private:
  LiveSource(std::string name, transport::Writer<bleed_v1_Frame> frames, transport::Writer<bleed_v1_FrameStats> stats,
             transport::Writer<bleed_v1_Scene> scenes, transport::Writer<bleed_v1_Status> statuses,
             transport::Writer<bleed_v1_Journal> journal);

  std::string name_;
  transport::Uuid session_ = transport::drawUuid();
  std::string scene_text_ = "name: \"live source\"\n";
  transport::Writer<bleed_v1_Frame> frames_;
  transport::Writer<bleed_v1_FrameStats> stats_;
  transport::Writer<bleed_v1_Scene> scenes_;
  transport::Writer<bleed_v1_Status> statuses_;
  transport::Writer<bleed_v1_Journal> journal_;
};

}  // namespace bleedsim::recording_test
