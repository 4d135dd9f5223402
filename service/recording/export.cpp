#include "service/recording/export.h"

#include <array>
#include <fmt/core.h>
#include <utility>

#include "service/recording/export_job.h"
#include "service/recording/part_file.h"

namespace bleedsim::recording {
namespace {

struct Row {
  ExportFormat format;
  std::string_view name;
  Result<ExportReport> (*run)(const ExportJob&);
  bool one_file;
};

constexpr std::array<Row, 4> kRows{{
    {ExportFormat::vtp, "vtp", exportVtp, false},
    {ExportFormat::ply, "ply", exportPly, false},
    {ExportFormat::csv, "csv", exportCsv, true},
    {ExportFormat::mcap_point_cloud, "mcap-pointcloud", exportPointCloud, true},
}};

}  // namespace

Result<ExportFormat> parseExportFormat(std::string_view name) {
  std::string names;
  for (const Row& row : kRows) {
    if (row.name == name) return row.format;
    names += (names.empty() ? "" : ", ") + std::string{row.name};
  }
  return ::bleedsim::Status{StatusCode::invalid_argument,
                            fmt::format("there is no format '{:.32}': choose one of {}", name, names)};
}

Result<ExportReport> exportRecording(const std::filesystem::path& recording, ExportFormat format,
                                     const std::filesystem::path& output, const FrameSelection& selection,
                                     const ExportProgress& progress) {
  const Row& row = kRows[static_cast<std::size_t>(format)];
  Result<RecordingReader> reader = RecordingReader::open(recording);
  if (!reader) return reader.status();
  const Result<std::size_t> total = reader->frameCount();
  if (!total) return total.status();
  Result<std::vector<std::size_t>> frames = selectFrames(selection, *total);
  if (!frames) return frames.status();
  const std::size_t digits = numberDigits(*total);
  if (!row.one_file) {
    Result<ExportReport> report = row.run({*reader, std::move(*frames), digits, output, progress});
    if (report) report->truncation_reason = reader->truncationReason();
    return report;
  }
  if (::bleedsim::Status status = checkTarget(recording, output); !status) return status;
  PartFile part{output};
  Result<ExportReport> report = row.run({*reader, std::move(*frames), digits, part.path(), progress});
  if (!report) return report;
  report->output = output;
  report->truncation_reason = reader->truncationReason();
  const ::bleedsim::Status kept = report->whole ? part.keep() : ::bleedsim::Status{};
  if (!kept.ok()) return kept;
  return report;
}

}  // namespace bleedsim::recording
