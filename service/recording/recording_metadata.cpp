#include "service/recording/recording_metadata.h"

#include <fmt/core.h>

namespace bleedsim::recording {
namespace {

std::string textOf(const std::map<std::string, std::string>& entries, const char* key) {
  const auto entry = entries.find(key);
  return entry == entries.end() ? std::string{} : entry->second;
}

std::uint64_t numberOf(const std::map<std::string, std::string>& entries, const char* key) {
  constexpr std::size_t kMaxDigits = 19;
  const std::string text = textOf(entries, key);
  if (text.size() > kMaxDigits) return 0;
  std::uint64_t value = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '9') return 0;
    value = value * 10 + static_cast<std::uint64_t>(digit - '0');
  }
  return value;
}

}  // namespace

mcap::Metadata toMetadata(const RecordingFigures& figures) {
  std::string ranges;
  for (const auto& [first, last] : figures.gap_ranges) ranges += fmt::format("{}{}-{}", ranges.empty() ? "" : " ", first, last);
  mcap::Metadata record{kRecordingMetadata, figures.origin};
  record.entries["frames"] = std::to_string(figures.frames);
  record.entries["gaps"] = std::to_string(figures.gaps);
  record.entries["gap_ranges"] = ranges;
  if (figures.published_until > 0) record.entries["published_until"] = std::to_string(figures.published_until);
  record.entries["skipped"] = std::to_string(figures.skipped);
  record.entries["refused"] = std::to_string(figures.refused);
  record.entries["journal_entries"] = std::to_string(figures.journal_entries);
  record.entries["journal_gaps"] = std::to_string(figures.journal_gaps);
  record.entries["replayable"] = figures.not_replayable.empty() ? "true" : "false";
  record.entries["reason"] = figures.not_replayable;
  for (const auto& [name, error] : figures.max_errors) record.entries["max_error_" + name] = fmt::format("{}", error);
  return record;
}

WriterKnowledge readKnowledge(const std::map<std::string, std::map<std::string, std::string>>& metadata) {
  WriterKnowledge out;
  const auto record = metadata.find(kRecordingMetadata);
  if (record == metadata.end()) {
    const auto notes = metadata.find(kNotesMetadata);
    out.thinned = notes != metadata.end() && notes->second.contains(kRateNote);
    return out;
  }
  out.published_until = numberOf(record->second, "published_until");
  out.skipped = numberOf(record->second, "skipped");
  out.refused = numberOf(record->second, "refused");
  out.gaps = numberOf(record->second, "gaps");
  if (textOf(record->second, "replayable") == "false") {
    const std::string reason = textOf(record->second, "reason");
    out.not_replayable = reason.empty() ? "the writer says so" : reason;
  }
  return out;
}

}  // namespace bleedsim::recording
