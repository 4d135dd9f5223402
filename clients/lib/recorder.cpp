#include "bleedsim/recorder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <fmt/core.h>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>

#include "clients/lib/client_impl.h"
#include "clients/lib/convert.h"
#include "clients/lib/frame_decoder.h"
#include "clients/lib/pinned_daemon.h"
#include "clients/lib/recording_window.h"
#include "service/recording/recording_writer.h"
#include "service/transport/clock.h"
#include "service/transport/receive_buffer.h"
#include "service/transport/uuid.h"

namespace bleedsim::client {
namespace {

using transport::Reader;
using transport::Reading;
using transport::Sample;
using transport::Topic;

constexpr std::int64_t kStatsGrace = 1'000'000'000;  // the statistics follow their frame at once
constexpr std::int64_t kFirstWord = 10'000'000'000;  // a daemon that lives gives its last status to a new reader at once

template <class T>
Result<Reader<T>> makeReader(const transport::Participant& participant, const std::string& session, Topic topic) {
  return Reader<T>::create(participant, session, transport::readerQos(topic, Reading::recorder));
}

Status checkLimits(const RecordingLimits& limits) {
  const auto positive = [](const std::optional<double>& value) { return !value || (std::isfinite(*value) && *value > 0.0); };
  if (positive(limits.duration_s) && positive(limits.rate_hz) && limits.frames.value_or(1) > 0) return {};
  return {StatusCode::invalid_argument, "duration, frames and rate of a recording have to be above 0"};
}

/// The daemon that runs the session, as far as the client has heard of it. A killed one and its successor are both known for a
/// while.
std::optional<Uuid> newestDaemon(const std::vector<SessionStatus>& sessions, const std::string& name) {
  const SessionStatus* newest = nullptr;
  for (const SessionStatus& session : sessions) {
    if (session.name == name && (newest == nullptr || session.start_stamp_ns > newest->start_stamp_ns)) newest = &session;
  }
  return newest == nullptr ? std::optional<Uuid>{} : newest->session;
}

}  // namespace

class Recorder::Impl {
 public:
  static constexpr unsigned kSamples = 0;
  static constexpr unsigned kGuard = 1;

  struct Endpoints {
    Reader<bleed_v1_Journal> journal;
    Reader<bleed_v1_Scene> scene;
    Reader<bleed_v1_Status> status;
    Reader<bleed_v1_FrameStats> stats;
    transport::GuardCondition guard;
    transport::WaitSet waits;
  };

  Impl(transport::Participant participant, std::string session, const std::optional<Uuid>& daemon, const RecordingLimits& limits,
       Endpoints endpoints, recording::RecordingWriter writer)
      : participant_{std::move(participant)},
        session_{std::move(session)},
        daemon_{daemon},
        endpoints_{std::move(endpoints)},
        writer_{std::move(writer)},
        window_{limits},
        thread_{[this] { serve(); }} {}
  ~Impl() { static_cast<void>(close().ok()); }

  RecordingProgress progress() const {
    const std::lock_guard lock{mutex_};
    return progress_;
  }
  bool waitDone(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    return changed_.wait_for(lock, timeout, [&] { return progress_.done; });
  }
  Status close();

 private:
  void serve();
  template <class T>
  bool drain(Reader<T>& reader);
  template <class T>
  void store(const Sample<T>& sample);
  void storeFrame(const bleed_v1_Frame& frame);
  void noteStatus(const Sample<bleed_v1_Status>& sample);
  void note(const Status& appended);
  void openFrames();
  bool daemonLost() const;
  bool complete();
  void publish(bool done);

  transport::Participant participant_;
  std::string session_;
  PinnedDaemon daemon_;
  Endpoints endpoints_;
  std::optional<Reader<bleed_v1_Frame>> frames_;
  std::mutex closing_;                 // one close() at a time
  recording::RecordingWriter writer_;  // of the thread, and of close() once that has ended
  RecordingWindow window_;
  Frame checked_;  // reused
  Status failure_;
  transport::BufferWatch buffer_watch_{transport::receiveBufferLimit()};
  std::string buffer_warning_;
  std::uint32_t capacity_ = 0;
  transport::PublicationHandle publication_ = 0;  // the status writer of our daemon; 0: not heard yet
  SessionState state_ = SessionState::unknown;
  std::string state_text_;
  bool scene_seen_ = false;
  bool gone_ = false;
  std::uint64_t last_seq_ = 0;
  std::uint64_t stats_seq_ = 0;
  std::uint64_t malformed_ = 0;
  std::uint32_t particles_ = 0;
  std::int64_t full_since_ = 0;
  std::int64_t started_ = transport::monotonicNow();

  mutable std::mutex mutex_;  // covers progress_ and closed_
  std::condition_variable changed_;
  RecordingProgress progress_;
  std::optional<Status> closed_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

void Recorder::Impl::note(const Status& appended) {
  // Samples that cannot be stored are counted by the writer; only a failing disk ends the recording.
  if (appended.code() == StatusCode::io && failure_.ok()) failure_ = appended;
}

template <class T>
void Recorder::Impl::store(const Sample<T>& sample) {
  if (!daemon_.owns(transport::toUuid(sample.data->session))) return;
  if constexpr (std::is_same_v<T, bleed_v1_Frame>) {
    storeFrame(*sample.data);
  } else {
    if constexpr (std::is_same_v<T, bleed_v1_Scene>) {
      scene_seen_ = true;
      capacity_ = sample.data->capacity;
    }
    if constexpr (std::is_same_v<T, bleed_v1_FrameStats>) {
      stats_seq_ = sample.data->seq;
      if (window_.full() && sample.data->seq > last_seq_) return;
    }
    if constexpr (std::is_same_v<T, bleed_v1_Status>) noteStatus(sample);
    note(writer_.append(*sample.data));
  }
}

void Recorder::Impl::noteStatus(const Sample<bleed_v1_Status>& sample) {
  SessionStatus status = fromWire(*sample.data);
  publication_ = sample.publication;
  state_ = status.state;
  state_text_ = std::move(status.text);
  gone_ = gone_ || state_ == SessionState::stopped;
}

void Recorder::Impl::storeFrame(const bleed_v1_Frame& frame) {
  if (window_.full()) return;
  if (!FrameDecoder::decode(frame, checked_).ok()) {
    ++malformed_;
    return;
  }
  if (frame.count > 0) {
    const std::size_t particle_bytes = frame.payload._length / frame.count;
    if (auto warning = buffer_watch_.note(particle_bytes * capacity_)) buffer_warning_ = std::move(*warning);
  }
  if (!window_.keep(frame.epoch, frame.sim_time_s)) {
    writer_.skip(frame);
    return;
  }
  note(writer_.append(frame));
  last_seq_ = frame.seq;
  particles_ = frame.count;
}

template <class T>
bool Recorder::Impl::drain(Reader<T>& reader) {
  for (;;) {
    const Result<std::size_t> taken = reader.take([&](const Sample<T>& sample) {
      if (sample.data != nullptr) store(sample);
    });
    if (!taken) return false;
    if (*taken < Reader<T>::kMaxBatch) return true;
  }
}

void Recorder::Impl::openFrames() {
  // Frames only once the scene is there and the journal flows: a recording starts with what explains it.
  if (frames_ || !scene_seen_ || endpoints_.journal.matchedCount() == 0) return;
  Result<Reader<bleed_v1_Frame>> made = makeReader<bleed_v1_Frame>(participant_, session_, Topic::frame);
  if (!made) {
    failure_ = made.status();
    return;
  }
  frames_.emplace(std::move(*made));
  if (Status attached = endpoints_.waits.attach(*frames_, kSamples); !attached) failure_ = attached;
}

bool Recorder::Impl::daemonLost() const {
  if (publication_ == 0) return transport::monotonicNow() - started_ > kFirstWord;
  // Liveliness tells first, but only that of all daemons of the name together.
  if (endpoints_.status.aliveCount() == 0) return true;
  const std::vector<transport::PublicationHandle> writers = endpoints_.status.matchedPublications();
  return std::find(writers.begin(), writers.end(), publication_) == writers.end();
}

bool Recorder::Impl::complete() {
  if (!failure_.ok() || gone_) return true;
  if (!window_.full()) return false;
  const std::int64_t now = transport::monotonicNow();
  if (full_since_ == 0) full_since_ = now;
  return stats_seq_ >= last_seq_ || now - full_since_ > kStatsGrace;
}

void Recorder::Impl::publish(bool done) {
  const recording::WriterCounts& counts = writer_.counts();
  {
    const std::lock_guard lock{mutex_};
    progress_ = {.frames = counts.frames,
                 .gaps = counts.gaps,
                 .malformed = malformed_ + counts.refused,
                 .particles = particles_,
                 .recorded_s = window_.recordedSeconds(),
                 .bytes = counts.bytes,
                 .done = done,
                 .complete = window_.full(),
                 .session_gone = gone_,
                 .replaced = daemon_.strangerHeard(),
                 .state = state_,
                 .state_text = state_text_,
                 .buffer_warning = buffer_warning_};
  }
  changed_.notify_all();
}

void Recorder::Impl::serve() {
  bool done = false;
  while (!done && !stopping_) {
    // Bounded, since matches are looked at here as well.
    const Result<transport::WakeUp> woken = endpoints_.waits.wait(std::chrono::milliseconds{100});
    if (!woken) failure_ = woken.status();
    const bool lost = daemonLost();  // asked first: what came before the end is still stored
    bool read = drain(endpoints_.scene) && drain(endpoints_.journal) && drain(endpoints_.status);
    if (frames_) read = read && drain(*frames_);
    read = read && drain(endpoints_.stats);
    if (!read && failure_.ok()) failure_ = {StatusCode::io, "the middleware refused to give samples"};
    gone_ = gone_ || lost;
    openFrames();
    done = complete();
    publish(done);
  }
  // Inputs of the steps up to the last frame may still lie in the reader.
  drain(endpoints_.journal);
  publish(true);
}

Status Recorder::Impl::close() {
  const std::lock_guard closing{closing_};
  {
    const std::lock_guard lock{mutex_};
    if (closed_) return *closed_;
  }
  stopping_ = true;
  endpoints_.guard.raise();
  if (thread_.joinable()) thread_.join();
  Status closed = writer_.close();
  if (!failure_.ok()) closed = failure_;
  const std::lock_guard lock{mutex_};
  closed_ = closed;
  progress_.bytes = writer_.counts().bytes;
  return closed;
}

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

Result<Recorder> Recorder::start(Client& client, const std::string& session, const std::string& path,
                                 const RecordingLimits& limits) {
  if (Status checked = checkLimits(limits); !checked) return checked;
  const transport::Participant participant = client.impl_->participant();
  const std::optional<Uuid> daemon = newestDaemon(client.sessions(), session);
  auto journal = makeReader<bleed_v1_Journal>(participant, session, Topic::journal);
  if (!journal) return journal.status();
  auto scene = makeReader<bleed_v1_Scene>(participant, session, Topic::scene);
  if (!scene) return scene.status();
  auto status = makeReader<bleed_v1_Status>(participant, session, Topic::status);
  if (!status) return status.status();
  auto stats = makeReader<bleed_v1_FrameStats>(participant, session, Topic::frame_stats);
  if (!stats) return stats.status();
  auto guard = transport::GuardCondition::create(participant);
  if (!guard) return guard.status();
  auto waits = transport::WaitSet::create(participant);
  if (!waits) return waits.status();
  for (const Status& attached :
       {waits->attach(*journal, Impl::kSamples), waits->attach(*scene, Impl::kSamples), waits->attach(*status, Impl::kSamples),
        waits->attach(*stats, Impl::kSamples), waits->attach(*guard, Impl::kGuard)}) {
    if (!attached.ok()) return attached;
  }
  Result<recording::RecordingWriter> writer = recording::RecordingWriter::open(path);
  if (!writer) return writer.status();
  Impl::Endpoints endpoints{std::move(*journal), std::move(*scene), std::move(*status),
                            std::move(*stats),   std::move(*guard), std::move(*waits)};
  return Recorder{std::make_unique<Impl>(participant, session, daemon, limits, std::move(endpoints), std::move(*writer))};
}

RecordingProgress Recorder::progress() const { return impl_->progress(); }
bool Recorder::waitDone(std::chrono::nanoseconds timeout) { return impl_->waitDone(timeout); }
Status Recorder::close() { return impl_->close(); }

}  // namespace bleedsim::client
