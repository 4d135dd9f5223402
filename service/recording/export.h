// Recording -> files for ParaView: one .vtp (VTK XML poly data, raw appended, little-endian) per frame and one .pvd that gives
// each its time. https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "service/recording/recording_reader.h"

namespace bleedsim::recording {

/// Called after each frame with the number done and in all; false ends the export there, with a .pvd of what was written.
using ExportProgress = std::function<bool(std::size_t done, std::size_t total)>;

struct ExportReport {
  std::size_t frames = 0;
  std::uint64_t bytes = 0;           ///< of all files
  std::filesystem::path collection;  ///< the .pvd
};

/// Writes frame_000000.vtp, ... and recording.pvd into `directory`, which is created when missing; files of the same names are
/// replaced. Times are simulated seconds; a further epoch goes on after the one before. Errors: io (the message names the file),
/// data_loss for frames that contradict themselves, not_found for a recording without frames.
Result<ExportReport> exportVtp(RecordingReader& reader, const std::filesystem::path& directory,
                               const ExportProgress& progress = {});

/// The text and bytes of one .vtp file.
Result<std::string> toVtp(const Frame& frame);

}  // namespace bleedsim::recording
