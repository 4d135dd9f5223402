// The publisher thread: everything that leaves the service goes through here.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "service/daemon/channels.h"
#include "service/daemon/session_guard.h"
#include "service/dds/frame_encoder.h"
#include "service/dds/session_encoder.h"
#include "service/transport/receive_buffer.h"
#include "service/transport/writer.h"

namespace bleedsim::daemon {

class Publisher {
 public:
  /// Creates the writers. The first status goes out with run().
  static Result<std::unique_ptr<Publisher>> create(const transport::Participant& participant,
                                                   const dds::SessionIdentity& identity, Channels& channels, SessionGuard guard);

  /// Publishes until requestStop() and then, once more, everything that is left, a last status "stopped" included. Calls
  /// `give_way` once, if another daemon of the same session name stays instead of this one, and `shown` once, when the first
  /// status is out.
  template <class GiveWay, class Shown>
  void run(GiveWay&& give_way, Shown&& shown) {
    bool first = true;
    while (!stop_requested_.load(std::memory_order_acquire)) {
      if (const std::optional<Rival> rival = findStrongerRival()) give_way(*rival);
      publishPending();
      channels_.publisher_pulse.beat();
      if (std::exchange(first, false)) shown();
      channels_.publisher.wait(next_status_);
    }
    finish();
  }

  /// From any thread. Nothing may be put into the channels afterwards.
  void requestStop();

 private:
  struct Writers {
    transport::Writer<bleed_v1_Frame> frame;
    transport::Writer<bleed_v1_FrameStats> stats;
    transport::Writer<bleed_v1_Scene> scene;
    transport::Writer<bleed_v1_Status> status;
    transport::Writer<bleed_v1_Reply> reply;
    transport::Writer<bleed_v1_Journal> journal;
  };

  Publisher(const dds::SessionIdentity& identity, Channels& channels, SessionGuard guard, Writers writers);

  std::optional<Rival> findStrongerRival();
  void publishPending();
  void publishScene();
  void publishReplies();
  void publishJournal();
  void publishFrame();
  void publishStatus();
  void writeStatus(const dds::StatusReport& report);
  void finish();
  void count(const Status& written);

  dds::Uuid session_;
  std::int64_t start_stamp_ns_;
  Channels& channels_;
  SessionGuard guard_;
  transport::BufferWatch buffer_watch_;
  Writers writers_;
  dds::FrameEncoder frame_encoder_;
  dds::FrameStatsEncoder stats_encoder_;
  dds::StatusEncoder status_encoder_;
  dds::SceneEncoder scene_encoder_;
  std::uint64_t seq_ = 0;
  std::uint64_t shown_revision_ = 0;
  TimePoint next_status_{};
  bool gave_way_ = false;
  std::atomic<bool> stop_requested_{false};
};

}  // namespace bleedsim::daemon
