#include "bleedsim/recorder.h"

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
#include "clients/lib/recorder_inputs.h"
#include "clients/lib/recording_end.h"
#include "clients/lib/recording_window.h"
#include "service/recording/recording_metadata.h"
#include "service/recording/recording_writer.h"
#include "service/transport/clock.h"
#include "service/transport/receive_buffer.h"
#include "service/transport/uuid.h"

namespace bleedsim::client {
namespace {

using transport::Sample;

constexpr std::int64_t kFirstWord = 10'000'000'000;  // a daemon that lives gives its last status to a new reader at once
// Matches are not waited for but looked at, and chunks grow old.
constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kLastTick{10};  // once the daemon ends, its writers are gone at any moment

Status checkLimits(const RecordingLimits& limits) {
  const auto positive = [](const std::optional<double>& value) { return !value || (std::isfinite(*value) && *value > 0.0); };
  if (positive(limits.duration_s) && positive(limits.rate_hz) && limits.frames.value_or(1) > 0) return {};
  return {StatusCode::invalid_argument, "duration, frames and rate of a recording have to be above 0"};
}

recording::Compression compressionOf(Compression compression) {
  switch (compression) {
    case Compression::none:
      return recording::Compression::none;
    case Compression::lz4:
      return recording::Compression::lz4;
    case Compression::zstd:
      break;
  }
  return recording::Compression::zstd;
}

/// The daemon that runs the session, as far as the client has heard of it. A killed one and its successor are both known for a
/// while.
std::optional<KnownDaemon> newestDaemon(const std::vector<SessionStatus>& sessions, const std::string& name) {
  const SessionStatus* newest = nullptr;
  for (const SessionStatus& session : sessions) {
    if (session.name == name && (newest == nullptr || session.start_stamp_ns > newest->start_stamp_ns)) newest = &session;
  }
  if (newest == nullptr) return {};
  return KnownDaemon{newest->session, newest->start_stamp_ns};
}

}  // namespace

class Recorder::Impl {
 public:
  Impl(RecorderInputs inputs, const std::optional<KnownDaemon>& daemon, const RecordingLimits& limits,
       recording::RecordingWriter writer)
      : inputs_{std::move(inputs)}, daemon_{daemon}, writer_{std::move(writer)}, window_{limits}, thread_{[this] { serve(); }} {}
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
  void look();
  void takeAll();
  template <class T>
  void store(const Sample<T>& sample);
  void noteStatus(const Sample<bleed_v1_Status>& sample);
  void noteFrame(const Sample<bleed_v1_Frame>& sample);
  void note(const Status& appended);
  void fail(const Status& status) {
    if (failure_.ok()) failure_ = status;
  }
  void publish(bool done);

  // Of the thread, and of close() once that has ended; only the inputs are woken by others.
  RecorderInputs inputs_;
  PinnedDaemon daemon_;
  recording::RecordingWriter writer_;
  RecordingWindow window_;
  RecordingEnd end_;
  Frame checked_;  // reused
  Status failure_;
  transport::BufferWatch buffer_watch_{transport::receiveBufferLimit()};
  std::string buffer_warning_;
  std::uint32_t capacity_ = 0;
  transport::PublicationHandle status_writer_ = 0;  // of our daemon; 0: not heard yet
  transport::PublicationHandle frame_writer_ = 0;
  transport::PublicationHandle stats_writer_ = 0;
  SessionState state_ = SessionState::unknown;
  std::string state_text_;
  bool scene_seen_ = false;
  std::uint64_t malformed_ = 0;
  std::uint32_t particles_ = 0;
  std::int64_t started_ = transport::monotonicNow();

  std::mutex closing_;        // one close() at a time
  mutable std::mutex mutex_;  // covers progress_ and closed_
  std::condition_variable changed_;
  RecordingProgress progress_;
  std::optional<Status> closed_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

void Recorder::Impl::note(const Status& appended) {
  // Samples that cannot be stored are counted by the writer; only a file that cannot be written ends the recording.
  const StatusCode code = appended.code();
  if (code == StatusCode::io || code == StatusCode::internal) fail(appended);
}

template <class T>
void Recorder::Impl::store(const Sample<T>& sample) {
  const T& data = *sample.data;
  const Uuid sender = transport::toUuid(data.session);
  if constexpr (std::is_same_v<T, bleed_v1_Status>) daemon_.started(sender, data.start_stamp_ns);
  if (!daemon_.owns(sender)) return;
  if constexpr (std::is_same_v<T, bleed_v1_Frame>) {
    noteFrame(sample);
  } else {
    if constexpr (std::is_same_v<T, bleed_v1_Scene>) {
      scene_seen_ = true;
      capacity_ = data.capacity;
    }
    if constexpr (std::is_same_v<T, bleed_v1_FrameStats>) {
      stats_writer_ = sample.publication;
      end_.stats(data.seq);
      if (!end_.wantsStats(data.seq)) return;
    }
    if constexpr (std::is_same_v<T, bleed_v1_Status>) noteStatus(sample);
    note(writer_.append(data));
  }
}

void Recorder::Impl::noteStatus(const Sample<bleed_v1_Status>& sample) {
  SessionStatus status = fromWire(*sample.data);
  status_writer_ = sample.publication;
  state_ = status.state;
  state_text_ = std::move(status.text);
  end_.status({status.epoch, status.step});
  if (state_ == SessionState::stopped) end_.stopped();
}

void Recorder::Impl::noteFrame(const Sample<bleed_v1_Frame>& sample) {
  const bleed_v1_Frame& frame = *sample.data;
  frame_writer_ = sample.publication;
  if (!end_.wantsFrames()) return;
  if (!FrameDecoder::decode(frame, checked_).ok()) {
    ++malformed_;
    return;
  }
  if (frame.count > 0) {
    const std::size_t particle_bytes = frame.payload._length / frame.count;
    if (auto warning = buffer_watch_.note(particle_bytes * capacity_)) buffer_warning_ = std::move(*warning);
  }
  end_.frame(frame.seq, {frame.epoch, frame.step});
  if (!window_.keep(frame.epoch, frame.sim_time_s)) {
    writer_.skip(frame);
    return;
  }
  note(writer_.append(frame));
  particles_ = frame.count;
  if (window_.full()) end_.enough();
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
                 .session_gone = end_.sessionGone(),
                 .replaced = daemon_.replaced(),
                 .state = state_,
                 .state_text = state_text_,
                 .failure = failure_.message(),
                 .buffer_warning = buffer_warning_};
  }
  changed_.notify_all();
}

/// What the middleware tells of the daemon's writers. Asked before the samples are taken: what came before the end is stored.
void Recorder::Impl::look() {
  if (end_.hasStopped()) {
    if (inputs_.streamsGone(frame_writer_, stats_writer_)) end_.writersGone();
    return;
  }
  const bool silent = status_writer_ == 0 && transport::monotonicNow() - started_ > kFirstWord;
  if (silent || (status_writer_ != 0 && inputs_.statusLost(status_writer_))) end_.lost();
}

void Recorder::Impl::takeAll() {
  if (Status taken = inputs_.take([this](const auto& sample) { store(sample); }); !taken) fail(taken);
}

void Recorder::Impl::serve() {
  while (failure_.ok() && !end_.over(transport::monotonicNow())) {
    if (stopping_) end_.enough();
    if (Status waited = inputs_.wait(end_.hasStopped() ? kLastTick : kTick); !waited) fail(waited);
    look();
    takeAll();
    if (scene_seen_ && !inputs_.framesOpen() && inputs_.journalFlows()) {
      if (Status opened = inputs_.openFrames(); !opened) fail(opened);
    }
    note(writer_.tick());
    publish(false);
  }
  // Streams do not wait for each other: what one brought while the others were read.
  takeAll();
  writer_.publishedUntil(end_.missingUntil());
  publish(true);
}

Status Recorder::Impl::close() {
  const std::lock_guard closing{closing_};
  {
    const std::lock_guard lock{mutex_};
    if (closed_) return *closed_;
  }
  stopping_ = true;
  inputs_.wake();
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
                                 const RecordingLimits& limits, const RecordingFormat& format) {
  if (Status checked = checkLimits(limits); !checked) return checked;
  const std::optional<KnownDaemon> daemon = newestDaemon(client.sessions(), session);
  Result<RecorderInputs> inputs = RecorderInputs::open(client.impl_->participant(), session);
  if (!inputs) return inputs.status();
  recording::WriterOptions options;
  options.compression = compressionOf(format.compression);
  options.quantize16 = format.quantize16;
  options.point_cloud = format.point_cloud;
  if (limits.rate_hz) options.notes[recording::kRateNote] = fmt::format("{}", *limits.rate_hz);
  Result<recording::RecordingWriter> writer = recording::RecordingWriter::open(path, options);
  if (!writer) return writer.status();
  return Recorder{std::make_unique<Impl>(std::move(*inputs), daemon, limits, std::move(*writer))};
}

RecordingProgress Recorder::progress() const { return impl_->progress(); }
bool Recorder::waitDone(std::chrono::nanoseconds timeout) { return impl_->waitDone(timeout); }
Status Recorder::close() { return impl_->close(); }

}  // namespace bleedsim::client
