// bleedlab torture: random scenes, checked after every step, and made small where they fail.
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fstream>
#include <memory>

#include "service/lab/app.h"
#include "service/lab/progress.h"
#include "service/lab/side_by_side.h"
#include "service/lab/torture/torture.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::uint64_t seed = 1;
  std::uint64_t count = 200;
  int steps = 120;
  int threads = 1;
  std::string model = "sound";
  std::string folder = ".";
};

TorturePlan planOf(const Arguments& arguments, std::uint64_t index) {
  const auto model = arguments.model == "literal" ? scene::Scene::LITERAL : scene::Scene::SOUND;
  return makePlan(arguments.seed + index, model, arguments.steps);
}

bool fails(const TorturePlan& plan) {
  const TortureOutcome outcome = runPlan(plan);
  return !outcome.refused && !outcome.holds;
}

/// Tells of a failure and writes the scene that is left of it.
Status report(const Arguments& arguments, std::uint64_t index) {
  const TorturePlan small = shrink(planOf(arguments, index), fails);
  const std::uint64_t seed = arguments.seed + index;
  const std::filesystem::path file = std::filesystem::path{arguments.folder} / fmt::format("torture_{}.textproto", seed);
  std::error_code error;
  std::filesystem::create_directories(arguments.folder, error);
  std::ofstream out{file};
  const std::string failure = runPlan(small).text;
  out << "# Fails: " << failure << "\n" << toText(small);
  out.close();
  fmt::print(
      "failed: --seed {} --count 1 --steps {} --model {}\n  {}\n  made small: {} particles, {} steps, {} commands, {} "
      "switches: {}\n",
      seed, arguments.steps, arguments.model, failure, particlesOf(small), small.steps, small.commands.size(),
      small.changes.size(), file.string());
  if (!out) return {StatusCode::io, "cannot write '" + file.string() + "'"};
  return {};
}

struct Totals {
  std::uint64_t ran = 0;
  std::uint64_t failed = 0;
  std::uint64_t particle_steps = 0;
  std::uint64_t switched = 0;
  std::uint64_t not_switched = 0;
  decltype(TortureOutcome::counters) counters{};

  void add(const TortureOutcome& outcome) {
    ++ran;
    failed += outcome.holds ? 0 : 1;
    particle_steps += outcome.particle_steps;
    switched += outcome.switched;
    not_switched += outcome.not_switched;
    for (std::size_t k = 0; k < counters.size(); ++k) counters[k] += outcome.counters[k];
  }
};

void print(const Totals& totals, std::uint64_t count) {
  fmt::print(
      "{} scenes ran, {} refused as invalid, {} failed; {:.1f} million particle-steps; effects switched {} times, {} times "
      "refused\n",
      totals.ran, count - totals.ran, totals.failed, 1e-6 * static_cast<double>(totals.particle_steps), totals.switched,
      totals.not_switched);
  fmt::print("counted:");
  for (std::size_t k = 0; k < totals.counters.size(); ++k) {
    if (totals.counters[k] > 0) fmt::print(" {} {}", sph::counterName(static_cast<sph::Counter>(k)), totals.counters[k]);
  }
  fmt::print("\n");
}

ExitCode run(const Arguments& arguments) {
  fmt::print("seed {}, {} scenes of {} steps, {} model\n", arguments.seed, arguments.count, arguments.steps, arguments.model);
  std::vector<TortureOutcome> outcomes(arguments.count);
  Progress progress{"torture"};
  runSideBySide(
      arguments.count, arguments.threads, [&](std::size_t k) { outcomes[k] = runPlan(planOf(arguments, k)); },
      [&](std::size_t done) { progress.report(static_cast<double>(done) / static_cast<double>(arguments.count)); });
  Totals totals;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k].refused) continue;
    totals.add(outcomes[k]);
    if (outcomes[k].holds) continue;
    if (Status status = report(arguments, k); !status.ok()) return fail(ExitCode::failed, status.message());
  }
  print(totals, arguments.count);
  return totals.failed == 0 ? ExitCode::done : ExitCode::missed;
}

}  // namespace

void addTortureCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("torture", "Run random scenes, commands and switches of effects; make small what fails");
  command->add_option("--seed", arguments->seed, "Of the first scene; the next ones count up from it")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--count", arguments->count, "Scenes")->capture_default_str()->check(CLI::Range(1U, 10000000U));
  command->add_option("--steps", arguments->steps, "Steps of each scene")->capture_default_str()->check(CLI::Range(1, 1000000));
  command->add_option("--threads", arguments->threads, "Scenes side by side")->capture_default_str()->check(CLI::Range(1, 64));
  command->add_option("--model", arguments->model, "sound or literal; the literal model may fault")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>{"sound", "literal"}).description(""));
  command->add_option("-o,--output", arguments->folder, "Where scenes that fail are written, as small as they still fail")
      ->capture_default_str()
      ->type_name("DIR");
  command->footer(
      "After every step: everything finite, nothing deeper in tissue than 0.1 spacings, count = injected - removed, no speed\n"
      "beyond the bound, every clamp counted; refused commands leave no trace, switched effects leave the motion as it is.\n"
      "Exit code 1: a scene failed, its seed is printed.");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
