// info and recover; the other commands on recordings have files of their own.
#include "clients/bleedctl/recording_commands.h"

#include <array>
#include <fmt/core.h>
#include <memory>

#include "clients/bleedctl/file_failure.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/long_work.h"
#include "service/recording/recover.h"
#include "service/recording/summary.h"

namespace bleedsim::bleedctl {
namespace {

struct Unit {
  const char* attribute;
  const char* unit;
};
constexpr std::array<Unit, 5> kUnits{
    {{"position", " m"}, {"velocity", " m/s"}, {"radius", " m"}, {"viscosity", " Pa s"}, {"density", " kg/m3"}}};

const char* unitOf(const std::string& attribute) {
  for (const Unit& row : kUnits) {
    if (attribute == row.attribute) return row.unit;
  }
  return "";
}

/// What 16-bit numbers cost, in words.
std::string quantizedText(const recording::RecordingSummary& s) {
  std::string errors;
  for (const auto& [name, error] : s.max_errors) {
    errors += fmt::format("{}{} within {:.2g}{}", errors.empty() ? "" : ", ", name, error, unitOf(name));
  }
  return fmt::format("16 bits, not bit-exact: {}; ids exact", errors);
}

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
  JsonObject errors;
  for (const auto& [name, error] : s.max_errors) errors.add(name, error);
  json.add("bit_exact", s.max_errors.empty()).raw("max_errors", errors.text()).add("compression", s.compression);
  JsonObject counters;
  for (const auto& [name, value] : s.fault_counters) counters.add(name, value);
  return json.add("file_bytes", s.file_bytes).raw("fault_counters", counters.text()).text();
}

int runInfo(const Context& context, const std::string& path) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return failOnRecording(reader.status(), path);
  const Result<recording::RecordingSummary> summary = recording::summarize(*reader);
  if (!summary) return failOnRecording(summary.status(), path);
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
  fmt::print("compression       {}\n", s.compression);
  if (!s.max_errors.empty()) fmt::print("precision         {}\n", quantizedText(s));
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
  if (!done) return fail(done.status().code() == StatusCode::invalid_argument ? kUsage : kFile, done.status().message());
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

}  // namespace

void addInfo(CLI::App& app, Context& context) {
  CLI::App* info = app.add_subcommand("info", "Say what a recording holds");
  const auto path = std::make_shared<std::string>();
  info->add_option("FILE", *path, "Recording")->required()->type_name("");
  info->callback([&context, path] { context.action = [&context, path] { return runInfo(context, *path); }; });
}

void addRecover(CLI::App& app, Context& context) {
  CLI::App* recover = app.add_subcommand("recover", "Make a complete file of a recording that was cut off or damaged");
  recover->footer(
      "After a crash, kill -9 or a full disk. Keeps every complete chunk: all but the last second. FILE stays as it is.\n\n" +
      recover->get_footer());
  const auto path = std::make_shared<std::string>();
  const auto output = std::make_shared<std::string>();
  recover->add_option("FILE", *path, "Recording")->required()->type_name("");
  recover->add_option("-o,--output", *output, "File to write, replaced if it exists")->required()->type_name("OUT");
  recover->callback(
      [&context, path, output] { context.action = [&context, path, output] { return runRecover(context, *path, *output); }; });
}

void addRecordingCommands(CLI::App& app, Context& context) {
  addRecord(app, context);
  addInfo(app, context);
  addRecover(app, context);
  addExport(app, context);
  addRender(app, context);
}

}  // namespace bleedsim::bleedctl
