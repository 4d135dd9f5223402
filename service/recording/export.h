// Recording -> files of other programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "service/recording/frame_selection.h"
#include "service/recording/recording_reader.h"

namespace bleedsim::recording {

enum class ExportFormat {
  vtp,               ///< a folder of .vtp and a .pvd with their times: ParaView
  ply,               ///< a folder of binary .ply: Blender, Houdini
  csv,               ///< one file, a line for each particle of each frame: pandas, spreadsheets
  mcap_point_cloud,  ///< one MCAP file with foxglove.PointCloud: Foxglove, Lichtblick
};

/// vtp, ply, csv or mcap-pointcloud; invalid_argument: the message lists them.
Result<ExportFormat> parseExportFormat(std::string_view name);

/// Called after each frame with the number done and in all; false ends the export.
using ExportProgress = std::function<bool(std::size_t done, std::size_t total)>;

struct ExportReport {
  std::size_t frames = 0;
  std::uint64_t bytes = 0;          ///< of all files
  std::filesystem::path output;     ///< what to open: the .pvd, the folder of .ply, or the file
  bool whole = true;                ///< false: the progress ended it
  std::string truncation_reason{};  ///< of the recording: it was cut off there; empty when it has its index
};

/// Files are numbered as the frames of the recording. A folder is created when missing, files of the same names are replaced; an
/// export into one file that is ended early leaves what was there before. Errors: io (the message names the file), data_loss for
/// frames that contradict themselves, otherwise as selectFrames(); invalid_argument: `output` is `recording`, or is no file where
/// one is to be written.
Result<ExportReport> exportRecording(const std::filesystem::path& recording, ExportFormat format,
                                     const std::filesystem::path& output, const FrameSelection& selection = {},
                                     const ExportProgress& progress = {});

}  // namespace bleedsim::recording
