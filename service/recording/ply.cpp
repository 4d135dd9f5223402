#include "service/recording/ply.h"

#include <bit>
#include <fmt/core.h>

#include "service/recording/export_job.h"
#include "service/recording/frame_columns.h"
#include "service/recording/write_file.h"

namespace bleedsim::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr std::size_t kPositions = 3;

void append(std::string& out, const auto& number) { out.append(reinterpret_cast<const char*>(&number), sizeof number); }

}  // namespace

Result<std::string> toPly(const Frame& frame) {
  FrameColumns columns;
  if (::bleedsim::Status status = toColumns(frame, columns); !status) return status;
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment bleedsim frame {} of epoch {}, {} s, in m and m/s\nelement vertex {}\n",
      frame.seq(), frame.epoch(), frame.sim_time_s(), frame.count());
  for (std::size_t c = 0; c < columns.columns.size(); ++c) {
    if (c == kPositions) out += "property uint id\n";
    out += "property float " + columns.columns[c].name + "\n";
  }
  if (columns.columns.size() == kPositions) out += "property uint id\n";
  out += "end_header\n";
  for (std::size_t i = 0; i < frame.count(); ++i) {
    for (std::size_t c = 0; c < columns.columns.size(); ++c) {
      if (c == kPositions) append(out, columns.ids[i]);
      append(out, columns.columns[c].values[i]);
    }
    if (columns.columns.size() == kPositions) append(out, columns.ids[i]);
  }
  return out;
}

Result<ExportReport> exportPly(const ExportJob& job) {
  if (::bleedsim::Status status = createFolder(job.output); !status) return status;
  ExportReport report;
  report.output = job.output;
  Frame frame;
  for (const std::size_t number : job.frames) {
    if (::bleedsim::Status status = job.reader.frame(number, frame); !status) return status;
    const Result<std::string> ply = toPly(frame);
    if (!ply) return ply.status();
    if (::bleedsim::Status status = writeFile(job.output / job.fileName(number, "ply"), *ply); !status) return status;
    report.bytes += ply->size();
    if (!job.goOn(report)) break;
  }
  return report;
}

}  // namespace bleedsim::recording
