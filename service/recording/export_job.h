// What the exports share: the frames to write, and the times of a whole recording.
#pragma once

#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "service/recording/export.h"

namespace bleedsim::recording {

struct ExportJob {
  RecordingReader& reader;
  std::vector<std::size_t> frames;  ///< numbers, rising, at least one
  std::size_t digits = 6;           ///< of a frame's number in file names
  const std::filesystem::path& output;
  const ExportProgress& progress;

  std::string fileName(std::size_t frame, const char* ending) const {
    return fmt::format("frame_{:0{}}.{}", frame, digits, ending);
  }
  /// After a frame; false: end.
  bool goOn(ExportReport& report) const {
    ++report.frames;
    if (!progress || progress(report.frames, frames.size())) return true;
    report.whole = report.frames == frames.size();
    return report.whole;
  }
};

Result<ExportReport> exportVtp(const ExportJob& job);
Result<ExportReport> exportPly(const ExportJob& job);
Result<ExportReport> exportCsv(const ExportJob& job);
Result<ExportReport> exportPointCloud(const ExportJob& job);

/// Times that rise through resets: an epoch goes on where the one before ended.
class Timeline {
 public:
  /// Simulated s of a frame; to be asked in the recording's order.
  double at(const Frame& frame) {
    const std::pair<std::string, std::uint32_t> epoch{frame.session(), frame.epoch()};
    if (started_ && epoch != epoch_) offset_ = last_;
    started_ = true;
    epoch_ = epoch;
    last_ = offset_ + frame.sim_time_s();
    return last_;
  }

 private:
  bool started_ = false;
  std::pair<std::string, std::uint32_t> epoch_;
  double offset_ = 0.0;
  double last_ = 0.0;
};

}  // namespace bleedsim::recording
