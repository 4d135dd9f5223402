// bleedlab hardcases: the hard cases, sound beside literal.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/app.h"
#include "service/lab/hardcases/report.h"
#include "service/lab/json_option.h"
#include "service/lab/lab_files.h"
#include "service/lab/machine.h"
#include "service/lab/progress.h"
#include "service/lab/side_by_side.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::vector<std::string> cases;
  std::string model = "both";
  std::string folder;
  int threads = 1;
  std::string json;
};

std::vector<CaseSetup> setupsOf(const std::string& model) {
  std::vector<CaseSetup> setups;
  for (const sph::Precision precision : {sph::Precision::float32, sph::Precision::float64}) {
    if (model != "literal") {
      setups.push_back({sph::Model::sound, precision, EffectChoice::all, true});
      setups.push_back({sph::Model::sound, precision, EffectChoice::needed, true});
    }
    if (model != "sound") setups.push_back({sph::Model::literal, precision, EffectChoice::needed, true});
  }
  return setups;
}

ExitCode run(const Arguments& arguments) {
  if (Status status = makeFolder(arguments.folder); !status.ok()) return fail(ExitCode::failed, status.message());
  const Machine machine = thisMachine();
  std::vector<CaseReport> reports;
  for (const HardCase& hard_case : hardCases()) {
    const bool wanted = arguments.cases.empty() ||
                        std::find(arguments.cases.begin(), arguments.cases.end(), hard_case.name) != arguments.cases.end();
    if (!wanted) continue;
    CaseReport report{&hard_case, setupsOf(arguments.model), {}};
    report.outcomes.resize(report.setups.size());
    reports.push_back(std::move(report));
  }
  const std::size_t each = reports.front().setups.size();
  const std::size_t jobs = reports.size() * each;
  Progress progress{"hardcases"};
  runSideBySide(
      jobs, arguments.threads,
      [&](std::size_t job) {
        CaseReport& report = reports[job / each];
        report.outcomes[job % each] = runHardCase(*report.hard_case, report.setups[job % each]);
      },
      [&](std::size_t finished) { progress.report(static_cast<double>(finished) / static_cast<double>(jobs)); });
  const nlohmann::json json = toJson(reports, machine);
  const std::string table = toMarkdown(reports, machine);
  if (arguments.json != "-") fmt::print("{}", table);
  if (Status status = writeJson(arguments.json, json); !status.ok()) return fail(ExitCode::failed, status.message());
  bool sound_holds = true;
  for (const CaseReport& report : reports) {
    for (std::size_t k = 0; k < each; ++k) {
      if (report.setups[k].model == sph::Model::literal || report.outcomes[k].holds()) continue;
      sound_holds = false;
      fmt::print(stderr, "bleedlab: {} ({}): {}\n", report.hard_case->name, describe(report.setups[k]),
                 describeFailures(report.outcomes[k]));
    }
  }
  if (!arguments.folder.empty()) {
    Status written = writeTextFile(arguments.folder, "hardcases.md", table);
    if (written.ok()) written = writeJson((std::filesystem::path{arguments.folder} / "hardcases.json").string(), json);
    if (!written.ok()) return fail(ExitCode::failed, written.message());
  }
  return sound_holds ? ExitCode::done : ExitCode::missed;
}

}  // namespace

void addHardCasesCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  std::vector<std::string> names;
  for (const HardCase& hard_case : hardCases()) names.emplace_back(hard_case.name);
  CLI::App* command = app.add_subcommand("hardcases", "Run the hard cases, sound beside literal: a table of figures and bounds");
  command->add_option("--case", arguments->cases, "Only these: " + fmt::format("{}", fmt::join(names, ", ")))
      ->type_name("NAME")
      ->check(CLI::IsMember(names).description(""));
  command->add_option("--model", arguments->model, "sound, literal or both")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>{"sound", "literal", "both"}).description(""));
  command->add_option("--threads", arguments->threads, "Cases side by side; more than 1 disturbs the timing of 'denormals'")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("-o,--output", arguments->folder, "Also write hardcases.md and hardcases.json here")->type_name("DIR");
  addJsonOption(*command, arguments->json);
  command->footer("Exit code 1: a case does not hold with the sound model. What the literal model fails is told only.");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
