// bleedlab validate: the solver against physics whose answer is known.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/app.h"
#include "service/lab/case_names.h"
#include "service/lab/json_option.h"
#include "service/lab/knob_options.h"
#include "service/lab/lab_files.h"
#include "service/lab/progress.h"
#include "service/lab/validation/report.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::vector<std::string> cases;
  KnobArguments knobs;
  std::string folder;
  std::string json;
  bool list = false;
};

ExitCode listCases() {
  for (const ValidationCase& one : validationCases())
    fmt::print("{:>2}  {:<20} {}: {}\n", one.number > 0 ? std::to_string(one.number) : "-", one.name, one.measures,
               one.reference);
  return ExitCode::done;
}

ExitCode run(const Arguments& arguments) {
  if (arguments.list) return listCases();
  const auto cases = casesOf(arguments.cases);
  if (!cases) return fail(ExitCode::usage, cases.status().message());
  const auto knobs = knobsOf(arguments.knobs);
  if (!knobs) return fail(ExitCode::usage, knobs.status().message());
  if (Status status = makeFolder(arguments.folder); !status.ok()) return fail(ExitCode::failed, status.message());
  ValidationRun all{*knobs, thisMachine(), {}};
  {
    Progress progress{"validate"};
    for (const ValidationCase* one : *cases) {
      auto result = one->run(*knobs);
      CaseOutcome outcome{one, {}, {}};
      if (result)
        outcome.result = std::move(*result);
      else
        outcome.status = result.status();
      all.outcomes.push_back(std::move(outcome));
      progress.report(static_cast<double>(all.outcomes.size()) / static_cast<double>(cases->size()));
    }
  }
  if (arguments.json != "-") fmt::print("{}", tableOf(all));
  if (Status status = writeJson(arguments.json, toJson(all)); !status.ok()) return fail(ExitCode::failed, status.message());
  if (!arguments.folder.empty()) {
    if (Status status = writeReport(arguments.folder, all); !status.ok()) return fail(ExitCode::failed, status.message());
  }
  const std::vector<std::string> misses = missesOf(all);
  for (const std::string& miss : misses) fmt::print(stderr, "bleedlab: {}\n", miss);
  if (std::any_of(all.outcomes.begin(), all.outcomes.end(), [](const CaseOutcome& one) { return !one.status.ok(); }))
    return ExitCode::failed;
  return misses.empty() ? ExitCode::done : ExitCode::missed;
}

}  // namespace

void addValidateCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("validate", "Compare the solver with physics whose answer is known");
  command->add_option("--case", arguments->cases, "Cases to run, by name; default all")->type_name("NAME");
  command->add_flag("--list", arguments->list, "Print the cases and end")->disable_flag_override();
  addKnobOptions(*command, arguments->knobs);
  command->add_option("-o,--output", arguments->folder, "Write report.md and plots here")->type_name("DIR");
  addJsonOption(*command, arguments->json);
  command->footer(
      "Exit code 1: a figure misses its threshold; each that does is named on stderr. 4: a case could not be run. What has no\n"
      "threshold is reported only.");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
