#include "service/daemon/publisher.h"

#include <spdlog/spdlog.h>
#include <utility>

#include "service/transport/clock.h"

namespace bleedsim::daemon {
namespace {

// Twice as often as readers are promised, so that a delayed thread keeps the promise.
constexpr std::chrono::milliseconds kStatusPeriod{250};
// Journal entries and replies of one round: the frame must not wait for a long backlog.
constexpr int kBatch = 512;
constexpr std::chrono::milliseconds kLastAcknowledgements{500};

}  // namespace

Result<std::unique_ptr<Publisher>> Publisher::create(const transport::Participant& participant,
                                                     const dds::SessionIdentity& identity, Channels& channels,
                                                     SessionGuard guard) {
  auto frame = transport::Writer<bleed_v1_Frame>::create(participant, identity.name);
  if (!frame) return frame.status();
  auto stats = transport::Writer<bleed_v1_FrameStats>::create(participant, identity.name);
  if (!stats) return stats.status();
  auto scene = transport::Writer<bleed_v1_Scene>::create(participant, identity.name);
  if (!scene) return scene.status();
  auto status = transport::Writer<bleed_v1_Status>::create(participant, identity.name);
  if (!status) return status.status();
  auto reply = transport::Writer<bleed_v1_Reply>::create(participant, identity.name);
  if (!reply) return reply.status();
  auto journal = transport::Writer<bleed_v1_Journal>::create(participant, identity.name);
  if (!journal) return journal.status();
  return std::unique_ptr<Publisher>{new Publisher{identity, channels, std::move(guard),
                                                  Writers{std::move(*frame), std::move(*stats), std::move(*scene),
                                                          std::move(*status), std::move(*reply), std::move(*journal)}}};
}

Publisher::Publisher(const dds::SessionIdentity& identity, Channels& channels, SessionGuard guard, Writers writers)
    : session_{identity.uuid},
      start_stamp_ns_{identity.start_stamp_ns},
      channels_{channels},
      guard_{std::move(guard)},
      buffer_watch_{transport::receiveBufferLimit()},
      writers_{std::move(writers)},
      frame_encoder_{identity.uuid},
      stats_encoder_{identity.uuid},
      status_encoder_{identity},
      scene_encoder_{identity} {}

void Publisher::requestStop() {
  stop_requested_.store(true, std::memory_order_release);
  channels_.publisher.notify();
}

// Asked on the thread that writes the status samples, so that the answer and the heartbeats that others have seen agree.
std::optional<Rival> Publisher::findStrongerRival() {
  std::optional<Rival> rival = guard_.poll();
  if (!rival || gave_way_ || !mustGiveWay({session_, start_stamp_ns_, status_encoder_.heartbeat()}, *rival)) return {};
  gave_way_ = true;
  return rival;
}

// The scene comes first: whoever gets a reply or frame of a new epoch can read its scene. Replies do not wait for a frame.
void Publisher::publishPending() {
  publishScene();
  publishReplies();
  publishFrame();
  publishJournal();
  publishStatus();
}

void Publisher::publishScene() {
  const std::shared_ptr<const dds::SceneReport> scene = channels_.board.takeScene();
  if (!scene) return;
  frame_encoder_.reserve(scene->capacity);
  count(writers_.scene.write(scene_encoder_.encode(*scene)));
}

void Publisher::publishReplies() {
  dds::Reply reply;
  for (int i = 0; channels_.replies.tryPop(reply); ++i) {
    if (reply.reply_stamp_ns == 0) {
      reply.reply_stamp_ns = transport::monotonicNow();
      if (reply.code == dds::ReplyCode::busy) {
        channels_.reply_cache.forget(reply.key);
      } else {
        channels_.reply_cache.finish(reply);
      }
    }
    count(writers_.reply.write(dds::encodeReply(reply)));
    if (i == kBatch) {
      channels_.publisher.notify();
      break;
    }
  }
}

void Publisher::publishJournal() {
  dds::JournalEntry entry;
  for (int i = 0; channels_.journal.tryPop(entry); ++i) {
    count(writers_.journal.write(dds::encodeJournal(session_, entry)));
    if (i == kBatch) {
      channels_.publisher.notify();
      break;
    }
  }
}

// A frame without a reader is not sent but counts as published: `seq` tells readers about frames that they missed, and nobody
// missed this one. A late joiner starts at whatever number is next.
void Publisher::publishFrame() {
  const dds::FrameSnapshot* snapshot = channels_.frames.load();
  if (snapshot == nullptr) return;
  ++seq_;
  if (writers_.frame.matchedCount() > 0) count(writers_.frame.write(frame_encoder_.encode(*snapshot, seq_)));
  if (writers_.stats.matchedCount() == 0) return;
  const ServiceCounters::All counts = channels_.counters.all();
  count(writers_.stats.write(stats_encoder_.encode(*snapshot, seq_, channels_.frames.overwritten(), counts)));
}

void Publisher::publishStatus() {
  const StatusBoard::Reading reading = channels_.board.read();
  const TimePoint now = Clock::now();
  if (reading.revision == shown_revision_ && now < next_status_) return;
  shown_revision_ = reading.revision;
  next_status_ = now + kStatusPeriod;
  writeStatus(reading.report);
  if (const auto warning = buffer_watch_.note(reading.report.full_frame_bytes)) spdlog::warn("{}", *warning);
}

void Publisher::writeStatus(const dds::StatusReport& report) {
  const ServiceCounters::All counts = channels_.counters.all();
  std::array<dds::ClientActivity, dds::kMaxClients> clients;
  const std::size_t known = channels_.clients.read(clients);
  count(writers_.status.write(status_encoder_.encode(report, counts, std::span{clients}.first(known))));
}

void Publisher::finish() {
  do { publishPending(); } while (!channels_.replies.empty() || !channels_.journal.empty());
  dds::StatusReport last = channels_.board.read().report;
  last.state = dds::SessionState::stopped;
  writeStatus(last);
  // Deleting a writer that waits for acknowledgements takes a second and may cut the last samples off.
  count(writers_.reply.waitForAcknowledgements(kLastAcknowledgements));
  count(writers_.frame.waitForAcknowledgements(kLastAcknowledgements));
  count(writers_.stats.waitForAcknowledgements(kLastAcknowledgements));
  count(writers_.journal.waitForAcknowledgements(kLastAcknowledgements));
  count(writers_.status.waitForAcknowledgements(kLastAcknowledgements));
}

void Publisher::count(const Status& written) {
  if (!written) channels_.counters.add(ServiceCounter::write_failures);
}

}  // namespace bleedsim::daemon
