// All frames in one table, a line for each particle of each frame.

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

#include "service/recording/export_job.h"
#include "service/recording/file_sink.h"
#include "service/recording/frame_columns.h"

namespace bleedsim::recording {
namespace {

/// Of all frames: a session may publish further attributes at any time.
Result<std::vector<std::string>> columnNames(const ExportJob& job) {
  std::vector<std::string> names;
  Frame frame;
  FrameColumns columns;
  for (const std::size_t number : job.frames) {
    if (::bleedsim::Status status = job.reader.frame(number, frame); !status) return status;
    if (::bleedsim::Status status = toColumns(frame, columns); !status) return status;
    for (const FrameColumns::Column& column : columns.columns) {
      if (std::find(names.begin(), names.end(), column.name) == names.end()) names.push_back(column.name);
    }
  }
  return names;
}

void appendLines(fmt::memory_buffer& out, std::size_t number, const Frame& frame, const FrameColumns& columns,
                 const std::vector<std::string>& names) {
  std::vector<const FrameColumns::Column*> ordered;
  for (const std::string& name : names) ordered.push_back(columns.find(name));
  const std::string start = fmt::format("{},{},{},", number, frame.epoch(), frame.sim_time_s());
  for (std::size_t i = 0; i < frame.count(); ++i) {
    out.append(start);
    fmt::format_to(std::back_inserter(out), "{}", columns.ids[i]);
    for (const FrameColumns::Column* column : ordered) {
      out.push_back(',');
      if (column != nullptr) fmt::format_to(std::back_inserter(out), "{}", column->values[i]);
    }
    out.push_back('\n');
  }
}

}  // namespace

Result<ExportReport> exportCsv(const ExportJob& job) {
  Result<FileSink> sink = FileSink::open(job.output);
  if (!sink) return sink.status();
  const Result<std::vector<std::string>> names = columnNames(job);
  if (!names) return names.status();
  std::string head = "frame,epoch,time_s,id";
  for (const std::string& name : *names) head += "," + name;
  if (::bleedsim::Status status = sink->write(head + "\n"); !status) return status;

  ExportReport report;
  Frame frame;
  FrameColumns columns;
  fmt::memory_buffer lines;
  for (const std::size_t number : job.frames) {
    if (::bleedsim::Status status = job.reader.frame(number, frame); !status) return status;
    if (::bleedsim::Status status = toColumns(frame, columns); !status) return status;
    lines.clear();
    appendLines(lines, number, frame, columns, *names);
    if (::bleedsim::Status status = sink->write({lines.data(), lines.size()}); !status) return status;
    if (!job.goOn(report)) break;
  }
  report.bytes = sink->bytes();
  if (::bleedsim::Status status = sink->closeQuickly(); !status) return status;
  return report;
}

}  // namespace bleedsim::recording
