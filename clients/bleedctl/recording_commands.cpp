// record, info and export.
#include <algorithm>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <unistd.h>

#include "bleedsim/recorder.h"
#include "clients/bleedctl/context.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/stop_signal.h"
#include "service/recording/export.h"
#include "service/recording/summary.h"

namespace bleedsim::bleedctl {
namespace {

constexpr std::chrono::milliseconds kTick{100};

struct RecordArguments {
  std::string path;
  double duration_s = 0.0;
  std::uint64_t frames = 0;
  double rate_hz = 0.0;
};

int failFile(const Status& status) { return fail(kFile, status.message()); }

/// One line on a terminal, redrawn; nothing elsewhere.
void drawProgress(const client::RecordingProgress& progress, const client::RecordingLimits& limits) {
  if (isatty(STDERR_FILENO) != 1) return;
  constexpr std::size_t kWidth = 30;
  std::string bar;
  if (limits.duration_s || limits.frames) {
    const double by_time = limits.duration_s ? progress.recorded_s / *limits.duration_s : 0.0;
    const double by_frames = limits.frames ? static_cast<double>(progress.frames) / static_cast<double>(*limits.frames) : 0.0;
    const double share = std::clamp(std::max(by_time, by_frames), 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(kWidth));
    bar = fmt::format("[{}{}] {:3.0f} % ", std::string(filled, '#'), std::string(kWidth - filled, '.'), share * 100.0);
  }
  fmt::print(stderr, "\r{}{:.2f} s, {} frames, {} gaps, {} particles, {:.1f} MB\x1b[K", bar, progress.recorded_s, progress.frames,
             progress.gaps, progress.particles, static_cast<double>(progress.bytes) * 1e-6);
}

int report(const Context& context, const std::string& path, const client::RecordingProgress& progress) {
  if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\n");
  if (context.json) {
    JsonObject json;
    json.add("file", path).add("frames", progress.frames).add("gaps", progress.gaps).add("malformed", progress.malformed);
    json.add("last_particles", progress.particles).add("duration_s", progress.recorded_s).add("bytes", progress.bytes);
    fmt::print("{}\n", json.add("session_gone", progress.session_gone).text());
  } else {
    fmt::print("{}: {} frames, {} gaps, {:.3f} s, {} particles, {:.1f} MB\n", path, progress.frames, progress.gaps,
               progress.recorded_s, progress.particles, static_cast<double>(progress.bytes) * 1e-6);
  }
  return kDone;
}

int runRecord(const Context& context, const std::string& path, const client::RecordingLimits& limits) {
  Result<client::Client> client = client::Client::create(context.connection);
  if (!client) return fail(client.status());
  const Result<client::SessionStatus> session = client->find(context.session, context.timeout());
  if (!session) return fail(session.status());
  holdStopSignals();
  Result<client::Recorder> recorder = client::Recorder::start(*client, session->name, path, limits);
  if (!recorder) return recorder.status().code() == StatusCode::io ? failFile(recorder.status()) : fail(recorder.status());
  bool interrupted = false;
  bool announced = isatty(STDERR_FILENO) == 1;  // a terminal shows the progress
  while (!interrupted && !recorder->progress().done) {
    interrupted = waitForStopSignal(kTick);
    const client::RecordingProgress progress = recorder->progress();
    drawProgress(progress, limits);
    if (!announced && progress.frames > 0) {
      fmt::print(stderr, "recording session '{}' into '{}'; Ctrl-C ends it\n", session->name, path);
      announced = true;
    }
  }
  const Status closed = recorder->close();
  const client::RecordingProgress progress = recorder->progress();
  report(context, path, progress);
  if (!closed.ok()) return failFile(closed);
  if (progress.session_gone && (limits.frames || limits.duration_s)) {
    return fail(kNoSession,
                fmt::format("session '{}' ended before the recording was complete; '{}' holds what came", session->name, path));
  }
  return kDone;
}

std::string infoJson(const std::string& path, const recording::RecordingSummary& s) {
  JsonObject json;
  json.add("file", path).add("frames", s.frames).add("gaps", s.gaps).add("skipped", s.skipped);
  json.add("first_particles", s.first_particles).add("last_particles", s.last_particles).add("max_particles", s.max_particles);
  json.add("duration_s", s.duration_s).add("wall_duration_s", s.wall_duration_s).add("epochs", s.epochs);
  json.add("ml_emitted", s.ml_emitted).add("ml_emitted_total", s.ml_emitted_total).add("has_ledger", s.has_ledger);
  json.add("mean_real_time_factor", s.mean_real_time_factor).add("replayable", s.replayable).add("reason", s.reason);
  json.add("truncated", s.truncated).add("truncation_reason", s.truncation_reason).add("journal_entries", s.journal_entries);
  json.add("journal_gaps", s.journal_gaps).add("session", s.session_name).add("scene", s.scene_name).add("version", s.version);
  json.add("build_id", s.build_id).add("simd_target", s.simd_target).add("precision", s.precision);
  JsonObject counters;
  for (const auto& [name, value] : s.fault_counters) counters.add(name, value);
  return json.add("file_bytes", s.file_bytes).raw("fault_counters", counters.text()).text();
}

int runInfo(const Context& context, const std::string& path) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return failFile(reader.status());
  const Result<recording::RecordingSummary> summary = recording::summarize(*reader);
  if (!summary) return failFile(summary.status());
  const recording::RecordingSummary& s = *summary;
  if (context.json) {
    fmt::print("{}\n", infoJson(path, s));
    return kDone;
  }
  fmt::print("file              {} ({:.1f} MB)\n", path, static_cast<double>(s.file_bytes) * 1e-6);
  if (s.session_name.empty()) {
    fmt::print("session           unknown\n");
  } else {
    fmt::print("session           {}, scene {}, bleedd {} ({})\n", s.session_name, s.scene_name, s.version, s.simd_target);
  }
  fmt::print("frames            {}, {} missing, {} left out\n", s.frames, s.gaps, s.skipped);
  fmt::print("particles         {} at first, {} at last\n", s.first_particles, s.last_particles);
  fmt::print("duration          {:.3f} simulated s, {:.3f} wall s\n", s.duration_s, s.wall_duration_s);
  fmt::print("blood             {:.3f} mL in the recording, {:.3f} mL since load\n", s.ml_emitted, s.ml_emitted_total);
  fmt::print("real-time factor  {:.2f}\n", s.mean_real_time_factor);
  fmt::print("replayable        {}\n", s.replayable ? std::string{"yes"} : "no: " + s.reason);
  for (const auto& [name, value] : s.fault_counters) {
    if (value != 0) fmt::print("{:<17} {}\n", name, value);
  }
  if (s.truncated) fmt::print("truncated         {}\n", s.truncation_reason);
  return kDone;
}

int runExport(const Context& context, const std::string& path, const std::string& directory) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return failFile(reader.status());
  holdStopSignals();
  bool interrupted = false;
  const auto progress = [&](std::size_t done, std::size_t total) {
    if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r{} of {} frames\x1b[K{}", done, total, done == total ? "\n" : "");
    interrupted = interrupted || waitForStopSignal(std::chrono::milliseconds{0});
    return !interrupted;
  };
  const Result<recording::ExportReport> done = recording::exportVtp(*reader, directory, progress);
  if (!done) return failFile(done.status());
  if (context.json) {
    JsonObject json;
    json.add("frames", std::uint64_t{done->frames}).add("bytes", done->bytes);
    fmt::print("{}\n", json.add("collection", done->collection.string()).text());
  } else {
    fmt::print("{} frames, {:.1f} MB: open {} in ParaView\n", done->frames, static_cast<double>(done->bytes) * 1e-6,
               done->collection.string());
  }
  return interrupted ? fail(kFailed, "interrupted: the export is incomplete") : kDone;
}

void addRecord(CLI::App& app, Context& context) {
  CLI::App* record = app.add_subcommand("record", "Record a session into an MCAP file until a limit or Ctrl-C");
  const auto v = std::make_shared<RecordArguments>();
  record->add_option("-o,--output", v->path, "File to write, replaced if it exists")->required()->type_name("FILE");
  CLI::Option* duration = record->add_option("--duration", v->duration_s, "Simulated seconds from the first frame")
                              ->check(finiteIn(1e-9, 1e9))
                              ->type_name("S");
  CLI::Option* frames = record->add_option("--frames", v->frames, "Number of frames")
                            ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40U))
                            ->type_name("N");
  duration->excludes(frames);
  CLI::Option* rate = record->add_option("--rate", v->rate_hz, "Record at most so many frames per simulated second")
                          ->check(finiteIn(1e-9, 1e6))
                          ->type_name("HZ");
  record->callback([&context, v, duration, frames, rate] {
    client::RecordingLimits limits;
    if (duration->count() > 0) limits.duration_s = v->duration_s;
    if (frames->count() > 0) limits.frames = v->frames;
    if (rate->count() > 0) limits.rate_hz = v->rate_hz;
    context.action = [&context, path = v->path, limits] { return runRecord(context, path, limits); };
  });
}

}  // namespace

void addRecordingCommands(CLI::App& app, Context& context) {
  addRecord(app, context);

  CLI::App* info = app.add_subcommand("info", "Say what a recording holds");
  const auto info_path = std::make_shared<std::string>();
  info->add_option("FILE", *info_path, "Recording")->required()->type_name("");
  info->callback([&context, info_path] { context.action = [&context, info_path] { return runInfo(context, *info_path); }; });

  CLI::App* out = app.add_subcommand("export", "Write a recording as .vtp files and a .pvd for ParaView");
  const auto out_path = std::make_shared<std::string>();
  const auto directory = std::make_shared<std::string>();
  out->add_option("FILE", *out_path, "Recording")->required()->type_name("");
  out->add_option("-o,--output", *directory, "Folder to write into, created if missing")->required()->type_name("DIR");
  out->callback([&context, out_path, directory] {
    context.action = [&context, out_path, directory] { return runExport(context, *out_path, *directory); };
  });
}

}  // namespace bleedsim::bleedctl
