#include <fmt/core.h>
#include <memory>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/file_failure.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/long_work.h"
#include "clients/bleedctl/recording_arguments.h"
#include "clients/bleedctl/recording_commands.h"
#include "service/recording/export.h"

namespace bleedsim::bleedctl {
namespace {

constexpr const char* kExportText =
    "Formats:\n"
    "  vtp              a folder: a .vtp for each frame, and recording.pvd with their times, to be opened in ParaView\n"
    "  ply              a folder: a binary .ply for each frame, for Blender and Houdini\n"
    "  csv              one file: frame,epoch,time_s,id,x,y,z,... with a line for each particle of each frame\n"
    "  mcap-pointcloud  one MCAP file with foxglove.PointCloud, for Foxglove and Lichtblick; a layout for them is\n"
    "                   share/bleedsim/recording/foxglove_layout.json of an installation, config/recording of the sources\n"
    "Files of a folder carry the numbers of the recording's frames. Lengths are metres, speeds m/s.\n\n";

struct ExportArguments : RecordingArguments {
  std::string format = "vtp";
};

const char* whatToDo(recording::ExportFormat format) {
  switch (format) {
    case recording::ExportFormat::vtp:
      return "open it in ParaView";
    case recording::ExportFormat::ply:
      return "import it in Blender or Houdini";
    case recording::ExportFormat::csv:
      return "one line for each particle of each frame";
    case recording::ExportFormat::mcap_point_cloud:
      break;
  }
  return "open it in Foxglove or Lichtblick";
}

int runExport(const Context& context, const ExportArguments& v) {
  const Result<recording::ExportFormat> format = recording::parseExportFormat(v.format);
  if (!format) return fail(format.status());
  LongWork work{"frames"};
  const auto progress = [&](std::size_t count, std::size_t total) { return work.goOn(count, total); };
  const Result<recording::ExportReport> done = recording::exportRecording(v.path, *format, v.output, v.selection(), progress);
  if (!done) return failOnRecording(done.status(), v.path);
  warnOfCut(v.path, done->truncation_reason);
  if (!done->whole) return fail(kInterrupted, "interrupted: the export is incomplete");
  if (context.json) {
    JsonObject json;
    json.add("format", v.format).add("frames", std::uint64_t{done->frames}).add("bytes", done->bytes);
    fmt::print("{}\n", json.add("output", done->output.string()).add("truncated", !done->truncation_reason.empty()).text());
  } else {
    fmt::print("{}: {} frames, {:.1f} MB; {}\n", done->output.string(), done->frames, static_cast<double>(done->bytes) * 1e-6,
               whatToDo(*format));
  }
  return kDone;
}

}  // namespace

void addExport(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("export", "Write a recording for ParaView, Blender, pandas or Foxglove");
  command->footer(kExportText + command->get_footer());
  const auto v = std::make_shared<ExportArguments>();
  v->addTo(*command);
  command->add_option("--format", v->format, "vtp, ply, csv or mcap-pointcloud")->capture_default_str()->type_name("FORMAT");
  command->add_option("-o,--output", v->output, "Folder or file to write; a folder is created if missing")
      ->required()
      ->type_name("OUT");
  command->callback([&context, v] { context.action = [&context, v] { return runExport(context, *v); }; });
}

}  // namespace bleedsim::bleedctl
