#include "clients/lib/recorder_inputs.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>
#include <vector>

namespace bleedsim::client {
namespace {

using transport::PublicationHandle;
using transport::Reader;
using transport::Reading;
using transport::Topic;

constexpr unsigned kSamples = 0;
constexpr unsigned kGuard = 1;

template <class T>
Result<Reader<T>> makeReader(const transport::Participant& participant, const std::string& session, Topic topic) {
  return Reader<T>::create(participant, session, transport::readerQos(topic, Reading::recorder));
}

template <class T>
bool writerGone(const Reader<T>& reader, PublicationHandle writer) {
  const std::vector<PublicationHandle> writers = reader.matchedPublications();
  if (writer == 0) return writers.empty();
  return std::find(writers.begin(), writers.end(), writer) == writers.end();
}

}  // namespace

Status RecorderInputs::failed(const Status& cause) {
  // A name that is no session's stays the caller's mistake.
  if (cause.code() == StatusCode::invalid_argument) return cause;
  return {StatusCode::unavailable,
          fmt::format("the middleware failed ({}); check the network interface and record again", cause.message())};
}

RecorderInputs::RecorderInputs(transport::Participant participant, std::string session, Reader<bleed_v1_Journal> journal,
                               Reader<bleed_v1_Scene> scene, Reader<bleed_v1_Status> status, Reader<bleed_v1_FrameStats> stats,
                               transport::GuardCondition guard, transport::WaitSet waits)
    : participant_{std::move(participant)},
      session_{std::move(session)},
      journal_{std::move(journal)},
      scene_{std::move(scene)},
      status_{std::move(status)},
      stats_{std::move(stats)},
      guard_{std::move(guard)},
      waits_{std::move(waits)} {}

Result<RecorderInputs> RecorderInputs::open(const transport::Participant& participant, const std::string& session) {
  auto journal = makeReader<bleed_v1_Journal>(participant, session, Topic::journal);
  if (!journal) return failed(journal.status());
  auto scene = makeReader<bleed_v1_Scene>(participant, session, Topic::scene);
  if (!scene) return failed(scene.status());
  auto status = makeReader<bleed_v1_Status>(participant, session, Topic::status);
  if (!status) return failed(status.status());
  auto stats = makeReader<bleed_v1_FrameStats>(participant, session, Topic::frame_stats);
  if (!stats) return failed(stats.status());
  auto guard = transport::GuardCondition::create(participant);
  if (!guard) return failed(guard.status());
  auto waits = transport::WaitSet::create(participant);
  if (!waits) return failed(waits.status());
  for (const Status& attached :
       {waits->attach(*journal, kSamples), waits->attach(*scene, kSamples), waits->attach(*status, kSamples),
        waits->attach(*stats, kSamples), waits->attach(*guard, kGuard)}) {
    if (!attached.ok()) return failed(attached);
  }
  return RecorderInputs{participant,        session,           std::move(*journal), std::move(*scene),
                        std::move(*status), std::move(*stats), std::move(*guard),   std::move(*waits)};
}

Status RecorderInputs::wait(std::chrono::nanoseconds timeout) {
  const Result<transport::WakeUp> woken = waits_.wait(timeout);
  if (woken && woken->has(kGuard)) guard_.lower();
  return woken ? Status{} : failed(woken.status());
}

Status RecorderInputs::openFrames() {
  Result<Reader<bleed_v1_Frame>> made = makeReader<bleed_v1_Frame>(participant_, session_, Topic::frame);
  if (!made) return failed(made.status());
  frames_.emplace(std::move(*made));
  const Status attached = waits_.attach(*frames_, kSamples);
  return attached.ok() ? Status{} : failed(attached);
}

bool RecorderInputs::statusLost(PublicationHandle writer) const {
  // Liveliness tells first, but only that of all daemons of the name together.
  return status_.aliveCount() == 0 || writerGone(status_, writer);
}

bool RecorderInputs::streamsGone(PublicationHandle frames, PublicationHandle stats) const {
  return (!frames_ || writerGone(*frames_, frames)) && writerGone(stats_, stats);
}

}  // namespace bleedsim::client
