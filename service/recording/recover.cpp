#include "service/recording/recover.h"

#include <fmt/core.h>
#include <limits>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "service/recording/channel_map.h"
#include "service/recording/mcap_reader.h"
#include "service/recording/mcap_writer.h"
#include "service/recording/part_file.h"
#include "service/recording/recording_metadata.h"
#include "service/recording/summary_collector.h"

namespace bleedsim::recording {
namespace {

namespace fs = std::filesystem;

class Copy {
 public:
  Copy(mcap::McapReader& from, std::map<std::uint16_t, Topic> topics, mcap::McapWriter& to)
      : from_{from}, topics_{std::move(topics)}, to_{to} {}

  /// The first error of the new file or of reading the old one; damaged chunks are counted instead.
  ::bleedsim::Status chunk(std::size_t index);
  ::bleedsim::Status metadata(const std::string& name);
  bool nothingKept() const { return messages_ == 0; }
  RecoverReport take() { return std::move(report_); }

 private:
  ::bleedsim::Status messages();

  mcap::McapReader& from_;
  std::map<std::uint16_t, Topic> topics_;
  mcap::McapWriter& to_;
  SummaryCollector collector_;
  RecoverReport report_;
  std::uint64_t messages_ = 0;  // written: a chunk that is whole may hold none of a recording's channels
};

::bleedsim::Status Copy::chunk(std::size_t index) {
  ::bleedsim::Status status = from_.loadChunk(index);
  if (status) status = messages();
  if (status.code() == StatusCode::data_loss) {
    ++report_.damaged_chunks;
    return {};
  }
  if (status) ++report_.chunks;
  // Here the disk may take its time: a chunk of the old file is all that waits for it.
  return status ? to_.flush() : status;
}

::bleedsim::Status Copy::messages() {
  std::uint64_t position = 0;
  for (;;) {
    mcap::Message message;
    Result<bool> more = from_.next(position, message);
    if (!more || !*more) return more.status();
    const auto topic = topics_.find(message.head.channel_id);
    if (topic != topics_.end()) {
      if (::bleedsim::Status added = collector_.add(
              {topic->second, message.head.sequence, message.head.log_time_ns, message.head.publish_time_ns, message.data});
          !added) {
        return added;
      }
    }
    if (!from_.index().channels.contains(message.head.channel_id)) continue;
    const std::string_view data{reinterpret_cast<const char*>(message.data.data()), message.data.size()};
    if (::bleedsim::Status written =
            to_.write(message.head.channel_id, message.head.log_time_ns, message.head.publish_time_ns, data);
        !written) {
      return written;
    }
    ++messages_;
  }
}

::bleedsim::Status Copy::metadata(const std::string& name) {
  const mcap::FileIndex& index = from_.index();
  const WriterKnowledge knowledge = readKnowledge(index.metadata);
  RecordingSummary& s = report_.summary;
  s = collector_.finish(knowledge);
  report_.reason = index.truncation_reason;
  RecordingFigures figures{.frames = s.frames,
                           .gaps = s.gaps,
                           .gap_ranges = s.gap_ranges,
                           .published_until = knowledge.published_until,
                           .skipped = s.skipped,
                           .refused = knowledge.refused,
                           .journal_entries = s.journal_entries,
                           .journal_gaps = s.journal_gaps,
                           .not_replayable = s.reason,
                           .max_errors = s.max_errors,
                           .origin = {}};
  if (s.scenes > 0) {
    figures.origin = {{"session_name", s.session_name}, {"scene_name", s.scene_name},   {"version", s.version},
                      {"build_id", s.build_id},         {"simd_target", s.simd_target}, {"precision", s.precision}};
  }
  ::bleedsim::Status status = to_.write(toMetadata(figures));
  for (const auto& [other, entries] : index.metadata) {
    if (status && other != kRecordingMetadata) status = to_.write(mcap::Metadata{other, entries});
  }
  if (!status) return status;
  return to_.write(mcap::Metadata{"bleedsim.recovered",
                                  {{"from", name},
                                   {"reason", report_.reason},
                                   {"chunks", std::to_string(report_.chunks)},
                                   {"damaged_chunks", std::to_string(report_.damaged_chunks)}}});
}

template <class Record>
std::vector<Record> valuesOf(const std::map<std::uint16_t, Record>& records) {
  std::vector<Record> out;
  for (const auto& [id, record] : records) out.push_back(record);
  return out;
}

}  // namespace

bool isRecoverable(const fs::path& from) {
  const Result<mcap::McapReader> file = mcap::McapReader::open(from, mcap::Damage::tolerate);
  return file && !file->index().chunks.empty();
}

Result<RecoverReport> recover(const fs::path& from, const fs::path& to, const RecoverProgress& progress) {
  Result<mcap::McapReader> file = mcap::McapReader::open(from, mcap::Damage::tolerate);
  if (!file) return file.status();
  Result<std::map<std::uint16_t, Topic>> topics = topicsOf(file->index());
  if (!topics) return topics.status();
  if (::bleedsim::Status status = checkTarget(from, to); !status) return status;
  if (file->index().chunks.empty()) {
    return ::bleedsim::Status{StatusCode::data_loss, fmt::format("'{}' holds no complete chunk: there is nothing to recover ({})",
                                                                 from.string(), file->index().truncation_reason)};
  }

  PartFile part{to};
  mcap::ChunkOptions options;
  options.age = std::chrono::hours{1};  // nothing is lost here by a crash
  options.queue_bytes = std::numeric_limits<std::size_t>::max();
  Result<mcap::McapWriter> writer =
      mcap::McapWriter::open(part.path(), options, valuesOf(file->index().schemas), valuesOf(file->index().channels));
  if (!writer) return writer.status();
  Copy copy{*file, std::move(*topics), *writer};
  const std::size_t chunks = file->index().chunks.size();
  for (std::size_t i = 0; i < chunks; ++i) {
    if (::bleedsim::Status status = copy.chunk(i); !status) return status;
    if (progress && !progress(i + 1, chunks)) {
      return ::bleedsim::Status{StatusCode::wrong_state, fmt::format("interrupted: '{}' was not written", to.string())};
    }
  }
  if (copy.nothingKept()) {
    return ::bleedsim::Status{
        StatusCode::data_loss,
        fmt::format("the chunks of '{}' are damaged or hold no messages of a recording: there is nothing to recover",
                    from.string())};
  }
  if (::bleedsim::Status status = copy.metadata(from.filename().string()); !status) return status;
  if (::bleedsim::Status status = writer->close(); !status) return status;
  RecoverReport report = copy.take();
  report.summary.file_bytes = writer->bytes();
  if (::bleedsim::Status status = part.keep(); !status) return status;
  return report;
}

}  // namespace bleedsim::recording
