#include "service/recording/recording_reader.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "service/recording/channel_map.h"
#include "service/recording/mcap_reader.h"

namespace bleedsim::recording {
namespace {

struct FramePlace {
  std::size_t chunk = 0;
  std::uint64_t offset = 0;
};

template <class Message>
::bleedsim::Status decodeAs(Topic topic, const RecordedMessage& message, Message& out) {
  if (message.topic != topic) {
    return {StatusCode::invalid_argument,
            fmt::format("a message of {} is no {}", infoOf(message.topic).channel, infoOf(topic).schema)};
  }
  if (message.data.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      !out.ParseFromArray(message.data.data(), static_cast<int>(message.data.size()))) {
    return {StatusCode::data_loss,
            fmt::format("message {} of {} does not parse; the file is damaged", message.sequence, infoOf(topic).channel)};
  }
  return {};
}

}  // namespace

::bleedsim::Status decode(const RecordedMessage& message, Frame& out) { return decodeAs(Topic::frame, message, out); }
::bleedsim::Status decode(const RecordedMessage& message, FrameStats& out) { return decodeAs(Topic::frame_stats, message, out); }
::bleedsim::Status decode(const RecordedMessage& message, recording::Status& out) {
  return decodeAs(Topic::status, message, out);
}
::bleedsim::Status decode(const RecordedMessage& message, Journal& out) { return decodeAs(Topic::journal, message, out); }
::bleedsim::Status decode(const RecordedMessage& message, Scene& out) { return decodeAs(Topic::scene, message, out); }

struct RecordingReader::Impl {
  explicit Impl(mcap::McapReader reader) : file{std::move(reader)} {}

  ::bleedsim::Status indexFrames();
  bool hasSelected(const mcap::ChunkIndex& entry) const;

  mcap::McapReader file;
  std::map<std::uint16_t, Topic> topics;  ///< by channel id
  std::set<Topic> selected{Topic::frame, Topic::frame_stats, Topic::status, Topic::journal, Topic::scene};
  std::size_t chunk = 0;
  std::uint64_t position = 0;
  std::optional<std::vector<FramePlace>> frames;
};

::bleedsim::Status RecordingReader::Impl::indexFrames() {
  if (frames) return {};
  std::vector<FramePlace> places;
  for (const auto& [id, topic] : topics) {
    if (topic != Topic::frame) continue;
    for (std::size_t i = 0; i < file.index().chunks.size(); ++i) {
      Result<std::vector<std::uint64_t>> offsets = file.messageOffsets(i, id);
      if (!offsets) return offsets.status();
      for (const std::uint64_t offset : *offsets) places.push_back({i, offset});
    }
  }
  frames = std::move(places);
  return {};
}

/// False: the file's index says that there is nothing to read in a chunk.
bool RecordingReader::Impl::hasSelected(const mcap::ChunkIndex& entry) const {
  // A cut may fall between a chunk and its message indexes.
  if (file.index().truncated || entry.message_index_offsets.empty()) return true;
  return std::any_of(topics.begin(), topics.end(), [&](const auto& topic) {
    return selected.contains(topic.second) && entry.message_index_offsets.contains(topic.first);
  });
}

Result<RecordingReader> RecordingReader::open(const std::filesystem::path& path) {
  Result<mcap::McapReader> file = mcap::McapReader::open(path);
  if (!file) return file.status();
  auto impl = std::make_unique<Impl>(std::move(*file));
  Result<std::map<std::uint16_t, Topic>> topics = topicsOf(impl->file.index());
  if (!topics) return topics.status();
  impl->topics = std::move(*topics);
  return RecordingReader{std::move(impl)};
}

RecordingReader::RecordingReader(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

bool RecordingReader::truncated() const { return impl_->file.index().truncated; }
const std::string& RecordingReader::truncationReason() const { return impl_->file.index().truncation_reason; }
std::uint64_t RecordingReader::fileBytes() const { return impl_->file.fileBytes(); }
std::string RecordingReader::compression() const {
  const std::vector<mcap::ChunkIndex>& chunks = impl_->file.index().chunks;
  if (chunks.empty()) return {};
  return chunks.front().compression.empty() ? std::string{nameOf(Compression::none)} : chunks.front().compression;
}
const std::map<std::string, std::map<std::string, std::string>>& RecordingReader::metadata() const {
  return impl_->file.index().metadata;
}
::bleedsim::Status RecordingReader::verify() const { return impl_->file.verify(); }

Result<bool> RecordingReader::next(RecordedMessage& out) {
  while (impl_->chunk < impl_->file.index().chunks.size()) {
    if (impl_->position == 0 && !impl_->hasSelected(impl_->file.index().chunks[impl_->chunk])) {
      ++impl_->chunk;
      continue;
    }
    if (::bleedsim::Status status = impl_->file.loadChunk(impl_->chunk); !status) return status;
    mcap::Message message;
    Result<bool> more = impl_->file.next(impl_->position, message);
    if (!more) return more.status();
    if (!*more) {
      ++impl_->chunk;
      impl_->position = 0;
      continue;
    }
    const auto topic = impl_->topics.find(message.head.channel_id);
    if (topic == impl_->topics.end() || !impl_->selected.contains(topic->second)) continue;
    out = {topic->second, message.head.sequence, message.head.log_time_ns, message.head.publish_time_ns, message.data};
    return true;
  }
  return false;
}

void RecordingReader::select(const std::set<Topic>& topics) {
  impl_->selected = topics;
  rewind();
}

void RecordingReader::rewind() {
  impl_->chunk = 0;
  impl_->position = 0;
}

Result<std::size_t> RecordingReader::frameCount() {
  if (::bleedsim::Status status = impl_->indexFrames(); !status) return status;
  return impl_->frames->size();
}

::bleedsim::Status RecordingReader::frame(std::size_t index, Frame& out) {
  if (::bleedsim::Status status = impl_->indexFrames(); !status) return status;
  if (index >= impl_->frames->size()) {
    return {StatusCode::not_found,
            fmt::format("there is no frame {}; the recording has {}, counted from 0", index, impl_->frames->size())};
  }
  const FramePlace& place = (*impl_->frames)[index];
  if (::bleedsim::Status status = impl_->file.loadChunk(place.chunk); !status) return status;
  std::uint64_t position = place.offset;
  mcap::Message message;
  Result<bool> found = impl_->file.next(position, message);
  if (!found) return found.status();
  const auto topic = *found ? impl_->topics.find(message.head.channel_id) : impl_->topics.end();
  if (topic == impl_->topics.end() || topic->second != Topic::frame ||
      position != place.offset + mcap::kRecordHeadBytes + mcap::kMessageHeadBytes + message.data.size()) {
    return {StatusCode::data_loss, fmt::format("the index of frame {} points elsewhere; the file is damaged", index)};
  }
  return decode({Topic::frame, message.head.sequence, message.head.log_time_ns, message.head.publish_time_ns, message.data}, out);
}

}  // namespace bleedsim::recording
