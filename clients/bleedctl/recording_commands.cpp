// info, recover and export; record has a file of its own.
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <unistd.h>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/record_command.h"
#include "clients/bleedctl/stop_signal.h"
#include "service/recording/export.h"
#include "service/recording/recover.h"
#include "service/recording/summary.h"

namespace bleedsim::bleedctl {
namespace {

int failFile(const Status& status) { return fail(kFile, status.message()); }

/// What to do with a file that is not whole.
std::string remedyFor(const std::string& path) {
  return fmt::format("'bleedctl recover {} -o OUT' makes a complete file of what it holds", path);
}

int failDamaged(const Status& status, const std::string& path) {
  if (status.code() != StatusCode::data_loss || !recording::isRecoverable(path)) return failFile(status);
  return fail(kFile, fmt::format("{}; {}", status.message(), remedyFor(path)));
}

/// Shows how far it is on a terminal, and ends with a signal.
class LongWork {
 public:
  explicit LongWork(const char* unit) : unit_{unit} { holdStopSignals(); }
  /// False: a signal came.
  bool goOn(std::size_t done, std::size_t total) {
    if (isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r{} of {} {}\x1b[K{}", done, total, unit_, done == total ? "\n" : "");
    interrupted_ = interrupted_ || waitForStopSignal(std::chrono::milliseconds{0});
    return !interrupted_;
  }
  bool interrupted() const { return interrupted_; }

 private:
  const char* unit_;
  bool interrupted_ = false;
};

std::string infoJson(const std::string& path, const recording::RecordingSummary& s) {
  JsonObject json;
  json.add("file", path).add("frames", s.frames).add("gaps", s.gaps).add("skipped", s.skipped);
  json.add("first_particles", s.first_particles).add("last_particles", s.last_particles).add("max_particles", s.max_particles);
  json.add("duration_s", s.duration_s).add("wall_duration_s", s.wall_duration_s).add("epochs", s.epochs);
  json.add("ml_emitted", s.ml_emitted).add("ml_emitted_total", s.ml_emitted_total).add("has_ledger", s.has_ledger);
  json.add("mean_real_time_factor", s.mean_real_time_factor).add("max_behind_s", s.max_behind_s);
  json.add("replayable", s.replayable).add("reason", s.reason);
  json.add("truncated", s.truncated).add("truncation_reason", s.truncation_reason);
  json.add("remedy", s.truncated ? remedyFor(path) : std::string{}).add("journal_entries", s.journal_entries);
  json.add("journal_gaps", s.journal_gaps).add("session", s.session_name).add("scene", s.scene_name).add("version", s.version);
  json.add("build_id", s.build_id).add("simd_target", s.simd_target).add("precision", s.precision);
  JsonObject counters;
  for (const auto& [name, value] : s.fault_counters) counters.add(name, value);
  return json.add("file_bytes", s.file_bytes).raw("fault_counters", counters.text()).text();
}

int runInfo(const Context& context, const std::string& path) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return failDamaged(reader.status(), path);
  const Result<recording::RecordingSummary> summary = recording::summarize(*reader);
  if (!summary) return failDamaged(summary.status(), path);
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
  fmt::print("real-time factor  {:.2f}, at most {:.3f} s behind\n", s.mean_real_time_factor, s.max_behind_s);
  fmt::print("replayable        {}\n", s.replayable ? std::string{"yes"} : "no: " + s.reason);
  for (const auto& [name, value] : s.fault_counters) {
    if (value != 0) fmt::print("{:<17} {}\n", name, value);
  }
  if (s.truncated) fmt::print("truncated         {}; {}\n", s.truncation_reason, remedyFor(path));
  return kDone;
}

int runRecover(const Context& context, const std::string& path, const std::string& output) {
  LongWork work{"chunks"};
  const Result<recording::RecoverReport> done =
      recording::recover(path, output, [&](std::size_t count, std::size_t total) { return work.goOn(count, total); });
  if (work.interrupted()) return fail(kInterrupted, done.status().message());
  if (!done) return done.status().code() == StatusCode::invalid_argument ? fail(done.status()) : failFile(done.status());
  const recording::RecordingSummary& s = done->summary;
  if (context.json) {
    JsonObject json;
    json.add("file", output).add("frames", s.frames).add("gaps", s.gaps).add("duration_s", s.duration_s);
    json.add("file_bytes", s.file_bytes).add("chunks", done->chunks).add("damaged_chunks", done->damaged_chunks);
    json.add("replayable", s.replayable).add("reason", s.reason);
    fmt::print("{}\n", json.add("truncation_reason", done->reason).text());
    return kDone;
  }
  fmt::print("{}: {} frames, {} gaps, {:.3f} s, {:.1f} MB\n", output, s.frames, s.gaps, s.duration_s,
             static_cast<double>(s.file_bytes) * 1e-6);
  fmt::print("{}: {}\n", path, done->reason.empty() ? "its index is there" : done->reason);
  if (done->damaged_chunks > 0)
    fmt::print("left out {} damaged chunks of {}\n", done->damaged_chunks, done->chunks + done->damaged_chunks);
  return kDone;
}

int runExport(const Context& context, const std::string& path, const std::string& directory) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return failFile(reader.status());
  LongWork work{"frames"};
  const Result<recording::ExportReport> done =
      recording::exportVtp(*reader, directory, [&](std::size_t count, std::size_t total) { return work.goOn(count, total); });
  if (!done) return failFile(done.status());
  if (context.json) {
    JsonObject json;
    json.add("frames", std::uint64_t{done->frames}).add("bytes", done->bytes);
    fmt::print("{}\n", json.add("collection", done->collection.string()).text());
  } else {
    fmt::print("{} frames, {:.1f} MB: open {} in ParaView\n", done->frames, static_cast<double>(done->bytes) * 1e-6,
               done->collection.string());
  }
  return work.interrupted() ? fail(kInterrupted, "interrupted: the export is incomplete") : kDone;
}

}  // namespace

void addRecordingCommands(CLI::App& app, Context& context) {
  addRecord(app, context);

  CLI::App* info = app.add_subcommand("info", "Say what a recording holds");
  const auto info_path = std::make_shared<std::string>();
  info->add_option("FILE", *info_path, "Recording")->required()->type_name("");
  info->callback([&context, info_path] { context.action = [&context, info_path] { return runInfo(context, *info_path); }; });

  CLI::App* recover = app.add_subcommand("recover", "Make a complete file of a recording that was cut off or damaged");
  recover->footer(
      "After a crash, kill -9 or a full disk. Keeps every complete chunk: all but the last second. FILE stays as it is.\n\n" +
      recover->get_footer());
  const auto recover_path = std::make_shared<std::string>();
  const auto recover_output = std::make_shared<std::string>();
  recover->add_option("FILE", *recover_path, "Recording")->required()->type_name("");
  recover->add_option("-o,--output", *recover_output, "File to write, replaced if it exists")->required()->type_name("OUT");
  recover->callback([&context, recover_path, recover_output] {
    context.action = [&context, recover_path, recover_output] { return runRecover(context, *recover_path, *recover_output); };
  });

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
