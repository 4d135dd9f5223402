#include "service/recording/recording_writer.h"

#include <algorithm>
#include <chrono>
#include <fmt/core.h>
#include <utility>

#include "service/recording/convert.h"
#include "service/recording/mcap_writer.h"
#include "service/recording/point_cloud.h"
#include "service/recording/quantize.h"
#include "service/recording/recording_metadata.h"
#include "service/recording/schemas.h"
#include "service/recording/seq_tracker.h"
#include "service/recording/text_check.h"

namespace bleedsim::recording {
namespace {

constexpr std::uint16_t kPointCloudId = kTopicCount + 1;  // of schema and channel
constexpr std::size_t kMaxNotes = 64;
constexpr int kMaxZstdLevel = 19;
constexpr std::size_t kMinChunkBytes = std::size_t{1} << 10;
constexpr std::size_t kMaxChunkBytes = std::size_t{64} << 20;
constexpr std::size_t kMinQueueBytes = std::size_t{64} << 10;
constexpr std::size_t kMaxQueueBytes = std::size_t{4} << 30;

::bleedsim::Status check(const WriterOptions& options) {
  if (options.zstd_level < 1 || options.zstd_level > kMaxZstdLevel) {
    return {StatusCode::invalid_argument, fmt::format("zstd level {} is not within 1 to {}", options.zstd_level, kMaxZstdLevel)};
  }
  if (options.chunk_bytes < kMinChunkBytes || options.chunk_bytes > kMaxChunkBytes) {
    return {StatusCode::invalid_argument,
            fmt::format("a chunk size of {} bytes is not within {} to {}", options.chunk_bytes, kMinChunkBytes, kMaxChunkBytes)};
  }
  if (options.chunk_age.count() <= 0) return {StatusCode::invalid_argument, "the age of a chunk has to be above 0"};
  if (options.queue_bytes < kMinQueueBytes || options.queue_bytes > kMaxQueueBytes) {
    return {StatusCode::invalid_argument, fmt::format("a queue of {} bytes for the disk is not within {} to {}",
                                                      options.queue_bytes, kMinQueueBytes, kMaxQueueBytes)};
  }
  if (options.notes.size() > kMaxNotes) {
    return {StatusCode::invalid_argument, fmt::format("{} notes are more than {}", options.notes.size(), kMaxNotes)};
  }
  for (const auto& [key, value] : options.notes) {
    if (!isUtf8(key) || !isUtf8(value)) return {StatusCode::invalid_argument, "a note is not UTF-8 text"};
  }
  return {};
}

SessionKey keyOf(const bleed_v1_Uuid& session) { return {reinterpret_cast<const char*>(session), sizeof(bleed_v1_Uuid)}; }

}  // namespace

struct RecordingWriter::Impl {
  explicit Impl(mcap::McapWriter file) : writer{std::move(file)} {}

  /// Of the conversion of a sample.
  ::bleedsim::Status count(::bleedsim::Status converted);
  /// Makes `frame` and, when it is asked for, `cloud` of the sample.
  ::bleedsim::Status convertFrame(const bleed_v1_Frame& sample);
  ::bleedsim::Status write(std::uint16_t channel_id, const google::protobuf::Message& message, std::uint64_t log_time_ns,
                           std::uint64_t publish_time_ns);
  template <class Sample, class Message>
  ::bleedsim::Status store(Topic topic, const Sample& sample, Message& message, std::uint64_t log_time_ns,
                           std::uint64_t publish_time_ns);
  ::bleedsim::Status finish();

  mcap::McapWriter writer;
  WriterOptions options;
  WriterCounts counts;
  FrameTracker frames;
  ReplayCheck replay;
  // Kept for their memory.
  Frame frame;
  foxglove::PointCloud cloud;
  FrameStats stats;
  std::string bytes;
  std::uint64_t last_time_ns = 0;
  MaxErrors errors;
  std::string frame_id;                       ///< of the last scene
  std::map<std::string, std::string> origin;  ///< of the first scene
  SessionKey last_session;                    ///< of the last frame
  std::uint64_t published_until = 0;
  bool closed = false;
  ::bleedsim::Status closing;
};

::bleedsim::Status RecordingWriter::Impl::count(::bleedsim::Status converted) {
  if (!converted) ++counts.refused;
  return converted;
}

::bleedsim::Status RecordingWriter::Impl::convertFrame(const bleed_v1_Frame& sample) {
  ::bleedsim::Status status = toRecording(sample, frame);
  if (status && options.point_cloud) status = toPointCloud(frame, frame_id, cloud);
  if (status && options.quantize16) status = quantize16(frame);
  for (const Attribute& attribute : frame.attributes()) errors.add(attribute);
  return status;
}

::bleedsim::Status RecordingWriter::Impl::write(std::uint16_t channel_id, const google::protobuf::Message& message,
                                                std::uint64_t log_time_ns, std::uint64_t publish_time_ns) {
  if (message.ByteSizeLong() > mcap::kMaxMessageBytes) {
    return count(
        {StatusCode::capacity, fmt::format("a sample of {} bytes is larger than {} bytes; use fewer particles or attributes",
                                           message.ByteSizeLong(), mcap::kMaxMessageBytes)});
  }
  if (!message.SerializeToString(&bytes)) return {StatusCode::internal, "a message could not be serialised"};
  last_time_ns = std::max(last_time_ns, log_time_ns);
  ::bleedsim::Status status =
      writer.write(channel_id, last_time_ns, publish_time_ns == 0 ? last_time_ns : publish_time_ns, bytes);
  counts.bytes = writer.bytes();
  return status;
}

template <class Sample, class Message>
::bleedsim::Status RecordingWriter::Impl::store(Topic topic, const Sample& sample, Message& message, std::uint64_t log_time_ns,
                                                std::uint64_t publish_time_ns) {
  if (closed) return {StatusCode::wrong_state, "the recording is closed"};
  if (::bleedsim::Status status = count(toRecording(sample, message)); !status) return status;
  return write(channelIdOf(topic), message, log_time_ns, publish_time_ns);
}

::bleedsim::Status RecordingWriter::Impl::finish() {
  const RecordingFigures figures{.frames = counts.frames,
                                 .gaps = counts.gaps,
                                 .gap_ranges = frames.ranges(),
                                 .published_until = published_until,
                                 .skipped = counts.skipped,
                                 .refused = counts.refused,
                                 .journal_entries = counts.journal_entries,
                                 .journal_gaps = counts.journal_gaps,
                                 .not_replayable = replay.reason(),
                                 .max_errors = errors.byName(),
                                 .origin = origin};
  ::bleedsim::Status status = writer.write(toMetadata(figures));
  // Closes the file even after an error, which it then reports again.
  ::bleedsim::Status closed_status = writer.close();
  counts.bytes = writer.bytes();
  return status ? closed_status : status;
}

Result<RecordingWriter> RecordingWriter::open(const std::filesystem::path& path, const WriterOptions& options) {
  if (::bleedsim::Status status = check(options); !status) return status;
  const mcap::ChunkOptions chunks{options.compression, options.zstd_level, options.chunk_bytes, options.chunk_age,
                                  options.queue_bytes};
  std::vector<mcap::Schema> schemas = recordingSchemas();
  std::vector<mcap::Channel> channels = recordingChannels();
  if (options.point_cloud) {
    schemas.push_back(pointCloudSchema(kPointCloudId));
    channels.push_back(pointCloudChannel(kPointCloudId, kPointCloudId));
  }
  Result<mcap::McapWriter> file = mcap::McapWriter::open(path, chunks, std::move(schemas), std::move(channels));
  if (!file) return file.status();
  std::map<std::string, std::string> notes = options.notes;
  if (options.quantize16) notes[kQuantizeNote] = "16";
  if (!notes.empty()) {
    if (::bleedsim::Status status = file->write(mcap::Metadata{kNotesMetadata, notes}); !status) return status;
  }
  auto impl = std::make_unique<Impl>(std::move(*file));
  impl->options = options;
  impl->counts.bytes = impl->writer.bytes();
  return RecordingWriter{std::move(impl)};
}

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;

RecordingWriter& RecordingWriter::operator=(RecordingWriter&& other) noexcept {
  if (this != &other) {
    if (impl_) static_cast<void>(close());
    impl_ = std::move(other.impl_);
  }
  return *this;
}

RecordingWriter::~RecordingWriter() {
  if (impl_) static_cast<void>(close());
}

::bleedsim::Status RecordingWriter::append(const bleed_v1_Frame& sample, std::uint64_t log_time_ns) {
  const auto published = static_cast<std::uint64_t>(std::max<std::int64_t>(sample.realtime_stamp_ns, 0));
  if (impl_->closed) return {StatusCode::wrong_state, "the recording is closed"};
  if (::bleedsim::Status status = impl_->count(impl_->convertFrame(sample)); !status) return status;
  ::bleedsim::Status status = impl_->write(channelIdOf(Topic::frame), impl_->frame, log_time_ns, published);
  if (status) {
    ++impl_->counts.frames;
    impl_->last_session = keyOf(sample.session);
    impl_->frames.add(impl_->last_session, sample.epoch, sample.seq);
    impl_->counts.gaps = impl_->frames.missing();
    impl_->replay.addFrame(keyOf(sample.session), sample.epoch);
    if (impl_->options.point_cloud) status = impl_->write(kPointCloudId, impl_->cloud, log_time_ns, published);
  }
  return status;
}

::bleedsim::Status RecordingWriter::append(const bleed_v1_FrameStats& sample, std::uint64_t log_time_ns) {
  ::bleedsim::Status status = impl_->store(Topic::frame_stats, sample, impl_->stats, log_time_ns, 0);
  if (status) {
    ++impl_->counts.frame_stats;
    impl_->replay.addState(keyOf(sample.session), sample.epoch, sample.journal_number);
  }
  return status;
}

::bleedsim::Status RecordingWriter::append(const bleed_v1_Status& sample, std::uint64_t log_time_ns) {
  recording::Status message;
  const auto published = static_cast<std::uint64_t>(std::max<std::int64_t>(sample.realtime_stamp_ns, 0));
  ::bleedsim::Status status = impl_->store(Topic::status, sample, message, log_time_ns, published);
  if (status) ++impl_->counts.statuses;
  return status;
}

::bleedsim::Status RecordingWriter::append(const bleed_v1_Scene& sample, std::uint64_t log_time_ns) {
  Scene message;
  ::bleedsim::Status status = impl_->store(Topic::scene, sample, message, log_time_ns, 0);
  if (status) {
    ++impl_->counts.scenes;
    impl_->frame_id = message.frame_id();
    impl_->replay.addScene(keyOf(sample.session), sample.epoch);
    if (impl_->origin.empty()) {
      impl_->origin = {{"session_name", message.session_name()}, {"scene_name", message.scene_name()},
                       {"version", message.version()},           {"build_id", message.build_id()},
                       {"simd_target", message.simd_target()},   {"precision", message.precision()}};
    }
  }
  return status;
}

::bleedsim::Status RecordingWriter::append(const bleed_v1_Journal& sample, std::uint64_t log_time_ns) {
  Journal message;
  ::bleedsim::Status status = impl_->store(Topic::journal, sample, message, log_time_ns, 0);
  if (status) {
    ++impl_->counts.journal_entries;
    impl_->replay.addJournal(keyOf(sample.session), sample.epoch, sample.number);
    if (message.has_restored()) {
      const Restored& source = message.restored();
      impl_->replay.addRestored(keyOf(sample.session), sample.epoch, source.session(), source.epoch(), source.number());
    }
    impl_->counts.journal_gaps = impl_->replay.journalGaps();
  } else {
    impl_->replay.loseJournal(keyOf(sample.session), sample.epoch);
  }
  return status;
}

::bleedsim::Status RecordingWriter::tick(std::chrono::steady_clock::time_point now) {
  if (impl_->closed) return {StatusCode::wrong_state, "the recording is closed"};
  ::bleedsim::Status status = impl_->writer.endOldChunk(now);
  impl_->counts.bytes = impl_->writer.bytes();
  return status;
}

void RecordingWriter::skip(const bleed_v1_Frame& sample) {
  ++impl_->counts.skipped;
  impl_->frames.add(keyOf(sample.session), sample.epoch, sample.seq);
  impl_->counts.gaps = impl_->frames.missing();
  impl_->last_session = keyOf(sample.session);
}

void RecordingWriter::publishedUntil(std::uint64_t seq) {
  impl_->published_until = std::max(impl_->published_until, seq);
  impl_->frames.publishedUntil(impl_->last_session, seq);
  impl_->counts.gaps = impl_->frames.missing();
}

::bleedsim::Status RecordingWriter::close() {
  if (!impl_->closed) {
    impl_->closing = impl_->finish();
    impl_->closed = true;
  }
  return impl_->closing;
}

const WriterCounts& RecordingWriter::counts() const { return impl_->counts; }

std::uint64_t RecordingWriter::now() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(
      std::max<std::int64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count(), 0));
}

}  // namespace bleedsim::recording
