// bleedlab paper NAME: the paper's experiments.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <thread>

#include "service/lab/app.h"
#include "service/lab/paper/claims.h"
#include "service/lab/paper/fig5.h"
#include "service/lab/paper/growth.h"
#include "service/lab/paper/intruders.h"
#include "service/lab/paper/paper_files.h"
#include "service/lab/paper/paper_scene.h"
#include "service/lab/paper/table2.h"
#include "service/lab/progress.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  PaperOptions options;
  std::optional<std::uint32_t> particles;
  std::optional<double> duration;
  std::string simd = "auto";
  std::string model = "both";
  bool json = false;
};

using Run = Result<PaperReport> (*)(const PaperOptions& options, const ProgressReport& progress);

struct Experiment {
  const char* name;
  const char* help;
  Run run;
  bool grows;          ///< has --particles
  bool counts;         ///< has --counts and --seconds
  bool models;         ///< has --model
  bool lasts = false;  ///< has --duration
};

constexpr std::array kExperiments{
    Experiment{"fig2", "Fast particles through a block in two dimensions, with and without repulsion", runFig2, false, false,
               true, true},
    Experiment{"fig5", "Blood from a round wound with each improvement switched off in turn", runFig5, true, false, true},
    Experiment{"fig6", "How the blood of a round wound spreads",
               [](const PaperOptions& options, const ProgressReport& progress) { return runGrowth(options, "fig6", progress); },
               true, false, false},
    Experiment{"fig8", "The same at the bottom of a hollow in an organ",
               [](const PaperOptions& options, const ProgressReport& progress) { return runGrowth(options, "fig8", progress); },
               true, false, false},
    Experiment{"table2", "Frames per second by complete search and by cube mesh", runTable2, false, true, false},
    Experiment{"claims", "The other claims of the paper that can be tested", runClaims, false, true, false},
};

/// The options with what the command line leaves to the experiment's scene.
Result<PaperOptions> optionsOf(const Experiment& experiment, const Arguments& arguments) {
  PaperOptions options = arguments.options;
  options.particles = arguments.particles.value_or(0);
  options.duration = arguments.duration.value_or(0.0);
  const bool particles = experiment.grows && !arguments.particles;
  const bool duration = experiment.lasts && !arguments.duration;
  if (!particles && !duration) return options;
  const bool literal = experiment.models && options.model == ModelChoice::literal;
  const auto scene = loadPaperScene(options, std::string{experiment.name} + (literal ? "_literal" : ""));
  if (!scene) return scene.status();
  if (particles) {
    const auto count = particlesOf(*scene);
    if (!count) return count.status();
    options.particles = *count;
  }
  if (duration) {
    const auto horizon = horizonOf(*scene);
    if (!horizon) return horizon.status();
    options.duration = *horizon;
  }
  return options;
}

Status run(const Experiment& experiment, const Arguments& arguments, nlohmann::json& results) {
  const auto options = optionsOf(experiment, arguments);
  if (!options) return options.status();
  Progress progress{experiment.name};
  auto report = experiment.run(*options, [&](double part) { progress.report(part); });
  if (!report) return report.status();
  if (Status status = writeReport(*options, experiment.name, *report); !status.ok()) return status;
  if (!arguments.json) fmt::print("{}", report->text);
  results[experiment.name] = std::move(report->json);
  return {};
}

ExitCode codeOf(const Status& status) {
  const bool scene = status.code() == StatusCode::invalid_argument || status.code() == StatusCode::not_found;
  return scene ? ExitCode::usage : ExitCode::failed;
}

ExitCode runAll(const std::vector<const Experiment*>& experiments, Arguments arguments) {
  auto target = sph::parseSimdTarget(arguments.simd);
  if (!target) return fail(ExitCode::usage, target.status().message());
  arguments.options.simd = *target;
  if (arguments.model == "sound") arguments.options.model = ModelChoice::sound;
  if (arguments.model == "literal") arguments.options.model = ModelChoice::literal;
  if (!arguments.options.folder.empty()) {
    std::error_code error;
    std::filesystem::create_directories(arguments.options.folder, error);
    if (error) return fail(ExitCode::failed, "cannot make folder '" + arguments.options.folder + "': " + error.message());
  }
  nlohmann::json results = nlohmann::json::object();
  for (const Experiment* experiment : experiments) {
    if (Status status = run(*experiment, arguments, results); !status.ok())
      return fail(codeOf(status), std::string{experiment->name} + ": " + status.message());
  }
  if (arguments.json) fmt::print("{}\n", (experiments.size() == 1 ? results.front() : results).dump(2));
  return ExitCode::done;
}

void addOptions(CLI::App& command, Arguments& arguments, const Experiment& has) {
  PaperOptions& options = arguments.options;
  command.add_option("-o,--output", options.folder, "Write pictures, plots, table and JSON here")->type_name("DIR");
  command.add_option("--scenes", options.scenes, "Folder of the scene files; default config/scenes/paper")->type_name("DIR");
  // A measured rate or cost is that of one core unless asked otherwise; figures do not depend on the number.
  if (has.grows && !has.counts) options.threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 64);
  command.add_option("--threads", options.threads, "Threads; figures do not depend on their number, measured rates do")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command.add_option("--simd", arguments.simd, "auto, scalar, avx2 or avx512")->capture_default_str();
  command.add_flag("--json", arguments.json, "Print JSON")->disable_flag_override();
  if (has.grows) {
    command.add_option("--particles", arguments.particles, "Particles at the end; default those of the scene's horizon_s")
        ->check(CLI::Range(100U, 1000000U));
  }
  if (has.models) {
    command.add_option("--model", arguments.model, "sound, literal or both")
        ->capture_default_str()
        ->check(CLI::IsMember({"sound", "literal", "both"}));
  }
  if (has.lasts) {
    command.add_option("--duration", arguments.duration, "Simulated time of the block at rest, s; default the scene's horizon_s")
        ->check(finiteIn(1e-3, 1e4));
  }
  if (has.counts) {
    command.add_option("--counts", options.counts, "Numbers of particles")
        ->capture_default_str()
        ->delimiter(',')
        ->check(CLI::Range(100U, 200000U));
    command.add_option("--seconds", options.seconds, "Wall time of the measurements, s")
        ->capture_default_str()
        ->check(finiteIn(0.01, 3600.0));
  }
}

}  // namespace

void addPaperCommand(CLI::App& app, Context& context) {
  CLI::App* paper = app.add_subcommand("paper", "Repeat an experiment of the paper");
  paper->require_subcommand(1);
  std::vector<const Experiment*> all;
  for (const Experiment& experiment : kExperiments) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = paper->add_subcommand(experiment.name, experiment.help);
    addOptions(*command, *arguments, experiment);
    command->callback(
        [arguments, one = &experiment, &context] { context.action = [arguments, one] { return runAll({one}, *arguments); }; });
    all.push_back(&experiment);
  }
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = paper->add_subcommand("all", "All of them, one after another");
  addOptions(*command, *arguments, {"all", "", nullptr, true, true, true, true});
  command->callback([arguments, all, &context] { context.action = [arguments, all] { return runAll(all, *arguments); }; });
}

}  // namespace bleedsim::lab
