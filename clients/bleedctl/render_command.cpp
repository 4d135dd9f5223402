#include <charconv>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/file_failure.h"
#include "clients/bleedctl/frame_painter.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/long_work.h"
#include "clients/bleedctl/recording_arguments.h"
#include "clients/bleedctl/recording_commands.h"
#include "service/picture/png_file.h"
#include "service/recording/part_file.h"
#include "service/recording/write_file.h"

namespace bleedsim::bleedctl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRenderText =
    "Draws the blood on the scene's tissue, without a display. One frame, by default the last, goes into OUT if that ends\n"
    "in .png; else OUT is a folder of frame_NUMBER.png. All pictures of one call share camera and colours. --color-by takes\n"
    "what the frames hold: speed, radius, platelet, viscosity or density.\n\n";

struct RenderArguments : RecordingArguments {
  std::string view = "oblique";
  std::string look = "liquid";
  std::string size = "960x720";
  PaintOptions options;
};

/// "WxH"; nothing for any other text.
std::optional<std::pair<int, int>> parseSize(const std::string& text) {
  const char* end = text.data() + text.size();
  int width = 0;
  int height = 0;
  const auto [cross, first] = std::from_chars(text.data(), end, width);
  if (first != std::errc{} || cross == end || *cross != 'x') return {};
  const auto [rest, second] = std::from_chars(cross + 1, end, height);
  if (second != std::errc{} || rest != end || width < 1 || height < 1) return {};
  return std::pair{width, height};
}

Result<PaintOptions> optionsOf(const RenderArguments& v) {
  PaintOptions out = v.options;
  const Result<picture::NamedView> view = picture::parseView(v.view);
  if (!view) return view.status();
  out.view = *view;
  if (v.look != "liquid") out.look = picture::BloodLook::spheres;
  const auto size = parseSize(v.size);
  if (!size) {
    return Status{StatusCode::invalid_argument, fmt::format("'{}' is no size: give WIDTHxHEIGHT in pixels, as 960x720", v.size)};
  }
  out.width = size->first;
  out.height = size->second;
  // Refuses what no picture may be, before the recording is read.
  if (const Result<picture::Image> image = picture::Image::create(out.width, out.height); !image) return image.status();
  return out;
}

struct Target {
  fs::path path;
  bool folder = false;

  fs::path of(std::size_t frame, std::size_t digits) const {
    return folder ? path / fmt::format("frame_{:0{}}.png", frame, digits) : path;
  }
};

Result<Target> targetOf(const RenderArguments& v) {
  Target target{v.output, v.each->count() > 0 || fs::path{v.output}.extension() != ".png"};
  if (!target.folder) {
    if (Status status = recording::checkTarget(v.path, target.path); !status) return status;
    return target;
  }
  if (fs::path{v.output}.extension() == ".png") {
    return Status{StatusCode::invalid_argument, fmt::format("'{}' is one picture, --every makes many: give a folder", v.output)};
  }
  if (Status status = recording::createFolder(target.path); !status) return status;
  return target;
}

int report(const Context& context, const RenderArguments& v, std::size_t pictures, const std::string& warning, bool truncated) {
  if (context.json) {
    JsonObject json;
    json.add("pictures", std::uint64_t{pictures}).add("output", v.output).add("warning", warning);
    fmt::print("{}\n", json.add("truncated", truncated).text());
  } else {
    fmt::print("{}: {} picture{}\n", v.output, pictures, pictures == 1 ? "" : "s");
  }
  return kDone;
}

int runRender(const Context& context, const RenderArguments& v) {
  const Result<PaintOptions> options = optionsOf(v);
  if (!options) return fail(kUsage, options.status().message());
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(v.path);
  if (!reader) return failOnRecording(reader.status(), v.path);
  const Result<std::size_t> total = reader->frameCount();
  if (!total) return failOnRecording(total.status(), v.path);
  recording::FrameSelection selection = v.selection();
  if (v.each->count() == 0 && !selection.frame && *total > 0) selection.frame = *total - 1;
  const Result<std::vector<std::size_t>> frames = recording::selectFrames(selection, *total);
  if (!frames) return failOnRecording(frames.status(), v.path);
  const Result<Target> target = targetOf(v);
  if (!target) return failOnRecording(target.status(), v.path);

  LongWork work{"steps"};
  const std::size_t steps = 2 * frames->size();
  Result<FramePainter> painter = FramePainter::create(
      *reader, *frames, *options, [&](std::size_t done, std::size_t /*frames*/) { return work.goOn(done, steps); });
  if (work.interrupted()) return fail(kInterrupted, "interrupted: nothing was drawn");
  if (!painter) return failOnRecording(painter.status(), v.path);
  std::size_t pictures = 0;
  for (const std::size_t frame : *frames) {
    const Result<picture::Image> image = painter->paint(*reader, frame);
    if (!image) return failOnRecording(image.status(), v.path);
    if (Status status = picture::writePng(target->of(frame, recording::numberDigits(*total)), *image); !status) {
      return fail(kFile, status.message());
    }
    ++pictures;
    if (!work.goOn(frames->size() + pictures, steps)) return fail(kInterrupted, "interrupted: pictures are missing");
  }
  warnOfCut(v.path, reader->truncationReason());
  if (!painter->warning().empty()) fmt::print(stderr, "warning: {}\n", painter->warning());
  return report(context, v, pictures, painter->warning(), reader->truncated());
}

}  // namespace

void addRender(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("render", "Draw frames of a recording as PNG pictures");
  command->footer(kRenderText + command->get_footer());
  const auto v = std::make_shared<RenderArguments>();
  v->addTo(*command);
  command->add_option("-o,--output", v->output, "Picture, or folder of pictures, created if missing")
      ->required()
      ->type_name("OUT");
  command->add_option("--view", v->view, "front, side, top or oblique")->capture_default_str()->type_name("VIEW");
  command->add_option("--size", v->size, "Pixels")->capture_default_str()->type_name("WxH");
  command->add_option("--look", v->look, "liquid, or spheres: every particle as it is")
      ->check(CLI::IsMember{{"liquid", "spheres"}})
      ->capture_default_str()
      ->type_name("LOOK");
  command->add_option("--color-by", v->options.color_by, "Colour particles by this instead of as blood")->type_name("WHAT");
  command->callback([&context, v] { context.action = [&context, v] { return runRender(context, *v); }; });
}

}  // namespace bleedsim::bleedctl
