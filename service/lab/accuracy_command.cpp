// bleedlab accuracy: error against time.
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/accuracy/report.h"
#include "service/lab/app.h"
#include "service/lab/case_names.h"
#include "service/lab/json_option.h"
#include "service/lab/lab_files.h"
#include "service/lab/progress.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::vector<std::string> cases{"hydrostatic", "poiseuille", "taylor_green", "incline", "platelet_spread"};
  std::vector<std::string> knobs = knobNames();
  double minutes = 6.0;
  bool no_effects = false;
  std::string folder;
  std::string json;
};

ExitCode run(const Arguments& arguments) {
  const auto cases = casesOf(arguments.cases);
  if (!cases) return fail(ExitCode::usage, cases.status().message());
  for (const ValidationCase* one : *cases) {
    if (one->error_figure.empty())
      return fail(ExitCode::usage, fmt::format("case '{}' has no figure to judge accuracy by; leave it out", one->name));
  }
  if (Status status = makeFolder(arguments.folder); !status.ok()) return fail(ExitCode::failed, status.message());
  AccuracyOptions options;
  options.cases = *cases;
  options.knobs = arguments.knobs;
  options.minutes = arguments.minutes;
  options.effects = !arguments.no_effects;
  AccuracyResults results;
  {
    Progress progress{"accuracy"};
    results = measureAccuracy(options, [&](double part) { progress.report(part); });
  }
  if (results.measurements.empty())
    return fail(ExitCode::failed,
                "nothing could be measured" + (results.left_out.empty() ? "" : ": " + results.left_out.front().reason));
  if (arguments.json != "-") fmt::print("{}\n\n{}", lineOf(results.machine), tablesOf(results));
  if (Status status = writeJson(arguments.json, toJson(results)); !status.ok()) return fail(ExitCode::failed, status.message());
  if (!arguments.folder.empty()) {
    if (Status status = writeReport(arguments.folder, results); !status.ok()) return fail(ExitCode::failed, status.message());
  }
  return ExitCode::done;
}

}  // namespace

void addAccuracyCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("accuracy", "Measure error against time over the solver's knobs");
  command->add_option("--cases", arguments->cases, "Validation cases that have an error figure")
      ->capture_default_str()
      ->delimiter(',')
      ->type_name("NAME");
  command->add_option("--knobs", arguments->knobs, "What is varied, one at a time")
      ->capture_default_str()
      ->delimiter(',')
      ->check(CLI::IsMember(knobNames()));
  command->add_option("--minutes", arguments->minutes, "Wall time that is kept; what does not fit is named as left out")
      ->capture_default_str()
      ->check(finiteIn(0.01, 600.0));
  command->add_flag("--no-effects", arguments->no_effects, "Leave the cost of each effect out")->disable_flag_override();
  command->add_option("-o,--output", arguments->folder, "Write accuracy.csv, accuracy.md and plots here")->type_name("DIR");
  addJsonOption(*command, arguments->json);
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
