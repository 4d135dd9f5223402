#include "service/lab/app.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace bleedsim::lab {
namespace {

constexpr const char* kFooter =
    "Progress and messages go to stderr, results to stdout; with --json (or --json -) stdout holds one JSON object and nothing "
    "else.\n"
    "Exit codes: 0 done; 1 done, and what was judged does not hold ('validate' misses a threshold, 'hardcases' or 'torture' "
    "finds\n"
    "a case that does not hold, nothing fits what 'choose' is asked for); 2 wrong command line or scene; 3 'replay --verify' "
    "found\n"
    "a difference, or that the recording cannot be compared; 4 the solver failed or a file cannot be written.";

/// The commands that were possible where the command line ended; empty if it was complete.
std::string commandsOf(const CLI::App& app) {
  const CLI::App* last = &app;
  while (!last->get_subcommands().empty()) last = last->get_subcommands().front();
  std::string names;
  for (const CLI::App* command : last->get_subcommands([](const CLI::App*) { return true; }))
    names += (names.empty() ? "" : ", ") + command->get_name();
  return names.empty() ? "" : "The commands are " + names + ".\n";
}

}  // namespace

ExitCode fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "bleedlab: {}\n", message);
  return code;
}

int runLab(int argc, const char* const* argv) {
  Context context;
  CLI::App app{"Experiments with the bleeding solver, without a service.", "bleedlab"};
  app.set_version_flag("--version", std::string{"bleedlab "} + BLEEDSIM_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  addEffectsCommand(app, context);
  addPaperCommand(app, context);
  addHardCasesCommand(app, context);
  addTortureCommand(app, context);
  addReplayCommand(app, context);
  addValidateCommand(app, context);
  addAccuracyCommand(app, context);
  addChooseCommand(app, context);
  addBenchCommand(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "bleedlab: {}\n{}See 'bleedlab --help' for what is possible.\n", error.what(), commandsOf(app));
    return static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(context.action());
}

}  // namespace bleedsim::lab
