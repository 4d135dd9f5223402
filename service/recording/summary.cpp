#include "service/recording/summary.h"

#include <set>

#include "service/recording/recording_metadata.h"
#include "service/recording/summary_collector.h"

namespace bleedsim::recording {

Result<RecordingSummary> summarize(RecordingReader& reader) {
  if (::bleedsim::Status status = reader.verify(); !status) return status;
  const std::set<Topic> all{Topic::frame, Topic::frame_stats, Topic::status, Topic::journal, Topic::scene};
  reader.select(all);
  SummaryCollector collector;
  for (;;) {
    RecordedMessage message;
    Result<bool> more = reader.next(message);
    if (!more) return more.status();
    if (!*more) break;
    if (::bleedsim::Status status = collector.add(message); !status) return status;
  }
  reader.rewind();
  RecordingSummary out = collector.finish(readKnowledge(reader.metadata()));
  out.truncated = reader.truncated();
  out.truncation_reason = reader.truncationReason();
  out.compression = reader.compression();
  out.file_bytes = reader.fileBytes();
  return out;
}

}  // namespace bleedsim::recording
