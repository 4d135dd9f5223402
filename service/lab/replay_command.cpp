// bleedlab replay FILE: simulates a recording again and compares its states.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "service/checkpoint/state_file.h"
#include "service/lab/app.h"
#include "service/lab/lab_files.h"
#include "service/lab/progress.h"
#include "service/replay/replay.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string file;
  bool verify = false;
  std::uint64_t from_step = 0;
  double speed = 0.0;  // simulated s per s; 0: as fast as it goes
  std::string json_file;
  std::string simd = "auto";
  std::string checkpoint;
  int threads = 1;
};

/// Waits so that recorded states pass at a constant speed, and prints them.
class PacedView {
 public:
  explicit PacedView(double speed) : speed_{speed} {}

  void see(const replay::RecordedState& state) {
    const Clock::time_point now = Clock::now();
    if (!last_ || state.sim_time < last_sim_time_) {
      start_ = now;
      start_sim_time_ = state.sim_time;
    }
    last_ = true;
    last_sim_time_ = state.sim_time;
    std::this_thread::sleep_until(start_ + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>{(state.sim_time - start_sim_time_) / speed_}));
    fmt::print(stderr, "step {:>9}  {:>10.4f} s  {:>8} particles\n", state.step, state.sim_time, state.particles);
  }

 private:
  double speed_;
  bool last_ = false;
  double last_sim_time_ = 0.0;
  double start_sim_time_ = 0.0;
  Clock::time_point start_{};
};

nlohmann::json toJson(const replay::EpochReplay& epoch) {
  nlohmann::json json{{"epoch", epoch.epoch},   {"first_step", epoch.first_step}, {"steps", epoch.steps},
                      {"inputs", epoch.inputs}, {"compared", epoch.compared},     {"equal", epoch.equal}};
  if (!epoch.broken.empty()) json["broken"] = epoch.broken;
  if (epoch.difference) {
    const replay::RecordedState& recorded = epoch.difference->recorded;
    json["first_difference"] = {{"step", recorded.step},
                                {"seq", recorded.seq},
                                {"sim_time_s", recorded.sim_time},
                                {"recorded_hash", fmt::format("{:016x}", recorded.hash)},
                                {"replayed_hash", fmt::format("{:016x}", epoch.difference->replayed_hash)}};
  }
  return json;
}

nlohmann::json toJson(const replay::ReplayReport& report, const Arguments& arguments) {
  nlohmann::json epochs = nlohmann::json::array();
  for (const replay::EpochReplay& epoch : report.epochs) epochs.push_back(toJson(epoch));
  return {{"file", arguments.file},         {"session", report.session_name}, {"recorded_by", report.build_id},
          {"simd", report.simd_target},     {"precision", report.precision},  {"threads", arguments.threads},
          {"bit_equal", report.bitEqual()}, {"notes", report.notes},          {"epochs", std::move(epochs)}};
}

void print(const replay::ReplayReport& report) {
  for (const std::string& note : report.notes) fmt::print("bit-equal states are not promised: {}\n", note);
  for (const replay::EpochReplay& epoch : report.epochs) {
    fmt::print("epoch {}: {} steps from step {}, {} inputs, {} of {} recorded states are bit-equal\n", epoch.epoch, epoch.steps,
               epoch.first_step, epoch.inputs, epoch.equal, epoch.compared);
    if (epoch.difference) {
      const replay::RecordedState& recorded = epoch.difference->recorded;
      fmt::print("  the first that differs is that of step {}, {:.6f} s: hash {:016x} recorded, {:016x} in the replay\n",
                 recorded.step, recorded.sim_time, recorded.hash, epoch.difference->replayed_hash);
    }
    if (!epoch.broken.empty()) fmt::print("  the replay ends early {}\n", epoch.broken);
  }
}

/// As replayRun refuses what cannot be compared: what is promised, a scene, a checkpoint or a state to compare is missing.
bool saysWhyNotComparable(StatusCode code) {
  return code == StatusCode::unsupported || code == StatusCode::not_found || code == StatusCode::data_loss;
}

ExitCode run(const Arguments& arguments) {
  const auto target = sph::parseSimdTarget(arguments.simd);
  if (!target) return fail(ExitCode::usage, target.status().message());
  auto recorded = replay::readRun(arguments.file);
  if (!recorded) return fail(ExitCode::usage, recorded.status().message());
  if (!recorded->truncated.empty()) {
    fmt::print(stderr, "bleedlab: the recording was cut off: {}; what is before is replayed\n", recorded->truncated);
  }
  replay::ReplayOptions options;
  options.threads = arguments.threads;
  options.simd = *target;
  options.verify = arguments.verify;
  options.from_step = arguments.from_step;
  if (!arguments.checkpoint.empty()) {
    auto checkpoint = checkpoint::readCheckpoint(arguments.checkpoint);
    if (!checkpoint) return fail(ExitCode::usage, "'" + arguments.checkpoint + "': " + checkpoint.status().message());
    options.checkpoint = std::move(*checkpoint);
  }
  PacedView view{arguments.speed};
  Progress progress{"replay"};
  if (arguments.speed > 0.0) {
    options.seen = [&view](const replay::RecordedState& state) { view.see(state); };
  } else {
    options.progress = [&progress](double part) { progress.report(part); };
  }
  const auto report = replay::replayRun(*recorded, options);
  if (!report) {
    const bool refused = arguments.verify && saysWhyNotComparable(report.status().code());
    return fail(
        refused ? ExitCode::differs : ExitCode::failed,
        (refused ? "'" + arguments.file + "' cannot be verified: " : "'" + arguments.file + "': ") + report.status().message());
  }
  if (arguments.json_file != "-") print(*report);
  if (Status status = writeJson(arguments.json_file, toJson(*report, arguments)); !status.ok()) {
    return fail(ExitCode::failed, status.message());
  }
  return arguments.verify && !report->bitEqual() ? ExitCode::differs : ExitCode::done;
}

}  // namespace

void addReplayCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("replay", "Simulate a recording again from its scene and inputs, and compare the states");
  command->add_option("file", arguments->file, "Recording of bleedctl record")->required()->type_name("FILE");
  command
      ->add_flag("--verify", arguments->verify,
                 "Demand bit-equal states: refuse what cannot be compared, and end with code 3 when a state differs")
      ->disable_flag_override();
  command->add_option("--from", arguments->from_step, "Compare and show states from this step of each epoch on")
      ->type_name("STEP");
  command->add_option("--speed", arguments->speed, "Let recorded states pass at this pace and print them")
      ->check(finiteIn(1e-4, 1e3))
      ->type_name("X");
  command->add_option("--json", arguments->json_file, "Write the result here; -: to stdout, in place of the lines")
      ->type_name("FILE");
  command
      ->add_option("--checkpoint", arguments->checkpoint, "The checkpoint that an epoch goes on from, if it is not in the file")
      ->type_name("FILE");
  command->add_option("--simd", arguments->simd, "auto, that of the recording; or scalar, avx2, avx512")->capture_default_str();
  command->add_option("--threads", arguments->threads, "Threads; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
