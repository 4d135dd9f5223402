// bleedlab bench: what a step costs, stage by stage, and how far that is from what the machine can do.
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "service/lab/app.h"
#include "service/lab/bench/comparison.h"
#include "service/lab/bench/report.h"
#include "service/lab/bench/still_block.h"
#include "service/lab/json_option.h"
#include "service/lab/lab_files.h"
#include "service/lab/progress.h"
#include "service/scene/scene.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::string scene;
  std::string model = "paper";
  std::vector<std::uint32_t> particles{20000};
  std::vector<int> threads{1};
  std::string simd = "auto";
  double seconds = 10.0;
  double warm_up = 0.5;
  std::string json;
  std::string compare;
};

Result<std::vector<BenchCase>> casesOf(const Arguments& arguments) {
  std::vector<BenchCase> cases;
  if (!arguments.scene.empty()) {
    const auto loaded = scene::loadScene(arguments.scene);
    if (!loaded) return loaded.status();
    for (const int threads : arguments.threads)
      cases.push_back({"scene", arguments.scene, loaded->world, 0.0, arguments.warm_up, threads});
    return cases;
  }
  for (const std::uint32_t particles : arguments.particles) {
    for (const int threads : arguments.threads) {
      cases.push_back({arguments.model, "", stillBlock(blockModelOf(arguments.model), particles), kBlockStep, 0.0, threads});
    }
  }
  return cases;
}

/// With its progress on stderr.
Result<BenchOutcome> measured(const std::vector<BenchCase>& cases, const BenchOptions& options) {
  Progress progress{"bench"};
  return measureCases(cases, options, [&progress](double part) { progress.report(part); });
}

ExitCode run(const Arguments& arguments) {
  const auto target = sph::parseSimdTarget(arguments.simd);
  if (!target) return fail(ExitCode::usage, target.status().message());
  std::optional<EarlierBench> earlier;
  if (!arguments.compare.empty()) {
    auto read = readBench(arguments.compare);
    if (!read) return fail(ExitCode::usage, read.status().message());
    earlier = std::move(*read);
  }
  const auto cases = casesOf(arguments);
  if (!cases) return fail(ExitCode::usage, cases.status().message());
  const auto outcome = measured(*cases, {.simd = *target, .seconds = arguments.seconds});
  if (!outcome) return fail(ExitCode::failed, outcome.status().message());
  const bool json_only = arguments.json == "-";
  if (!json_only) fmt::print("{}", tablesOf(*outcome));
  if (earlier) fmt::print(json_only ? stderr : stdout, "{}", comparisonOf(*outcome, *earlier, arguments.compare));
  if (Status status = writeJson(arguments.json, toJson(*outcome)); !status.ok()) return fail(ExitCode::failed, status.message());
  return ExitCode::done;
}

}  // namespace

void addBenchCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("bench", "Measure a step stage by stage, against the machine's roofline");
  CLI::Option* scene =
      command->add_option("--scene", arguments->scene, "Scene to measure, from where it is after --warm-up")->type_name("SCENE");
  CLI::Option* model = command
                           ->add_option("--model", arguments->model,
                                        "Still block to measure: the paper's terms in one sweep, pressure and viscosity only, or "
                                        "every effect of the sound model")
                           ->capture_default_str()
                           ->check(CLI::IsMember(blockModelNames()));
  CLI::Option* particles = command->add_option("--particles", arguments->particles, "Of the block, about; a case for each")
                               ->capture_default_str()
                               ->delimiter(',')
                               ->check(CLI::Range(1000U, 1000000U));
  scene->excludes(model)->excludes(particles);
  command->add_option("--threads", arguments->threads, "A case for each")
      ->capture_default_str()
      ->delimiter(',')
      ->check(CLI::Range(1, 64));
  command->add_option("--simd", arguments->simd, "auto, scalar, avx2 or avx512")->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "Wall time after which no further turn begins, preparation apart, s")
      ->capture_default_str()
      ->check(finiteIn(0.01, 3600.0));
  command->add_option("--warm-up", arguments->warm_up, "Simulated time before the scene is measured, s")
      ->capture_default_str()
      ->check(finiteIn(0.0, 1000.0))
      ->needs(scene);
  addJsonOption(*command, arguments->json);
  command
      ->add_option("--compare", arguments->compare,
                   "Earlier file of --json: print how many times as fast each stage is; to stderr where the JSON takes stdout")
      ->type_name("FILE");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
