// Reads a recording back: messages in the order in which they were written, or frames by number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "idl/recording.pb.h"
#include "service/recording/topics.h"
#include "service/status/status.h"

namespace bleedsim::recording {

struct RecordedMessage {
  Topic topic = Topic::frame;
  std::uint32_t sequence = 0;  ///< of the channel in this file, from 0
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::span<const std::byte> data;  ///< serialised message, valid until the reader's next call
};

/// data_loss when the bytes are no such message, invalid_argument when the message is of another topic.
::bleedsim::Status decode(const RecordedMessage& message, Frame& out);
::bleedsim::Status decode(const RecordedMessage& message, FrameStats& out);
::bleedsim::Status decode(const RecordedMessage& message, recording::Status& out);
::bleedsim::Status decode(const RecordedMessage& message, Journal& out);
::bleedsim::Status decode(const RecordedMessage& message, Scene& out);

/// Not thread-safe. Holds the file's index and one chunk in memory.
class RecordingReader {
 public:
  /// A file that was cut off (crash, full disk) opens too: see truncated(). Errors: io, not_found, data_loss for damage and for
  /// files that are no recordings, unsupported for MCAP features that recordings do not use.
  static Result<RecordingReader> open(const std::filesystem::path& path);

  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  /// True: the file has no complete index, it was read from the start up to the last complete chunk.
  bool truncated() const;
  /// Empty, or where and why reading ends early.
  const std::string& truncationReason() const;

  std::uint64_t fileBytes() const;
  /// Of the first chunk: none, lz4 or zstd; empty when there is none.
  std::string compression() const;
  /// Metadata records of the file by name; empty when the writer never came to write them.
  const std::map<std::string, std::map<std::string, std::string>>& metadata() const;

  /// Compares the checksum of the whole data section; reads the file once. data_loss when it is another. A file that was cut off
  /// has none and passes.
  ::bleedsim::Status verify() const;

  /// The next message of the selected topics; false at the end. data_loss: a checksum or a length is wrong.
  Result<bool> next(RecordedMessage& out);
  /// Only these topics from now on; starts again at the first message.
  void select(const std::set<Topic>& topics);
  void rewind();

  /// Builds the frame index at the first call.
  Result<std::size_t> frameCount();
  /// Frame number `index` in file order. not_found: there are fewer.
  ::bleedsim::Status frame(std::size_t index, Frame& out);

 private:
  struct Impl;
  explicit RecordingReader(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::recording
