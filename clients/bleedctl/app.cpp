// The command line: global options, commands, messages about wrong use.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/core.h>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/stop_signal.h"
#include "service/status/number_text.h"

namespace bleedsim::bleedctl {
namespace {

constexpr const char* kGlobalOptionsText =
    "Options of every command, before or after it: --domain N, --interface NAME,\n"
    "--session NAME, --json, --timeout S; 'bleedctl --help' explains them.\n"
    "Positions are X,Y,Z in metres, in the frame of the scene.\n\n";

void addGlobalOptions(CLI::App& app, Context& context) {
  app.add_option("--domain", context.connection.domain, "DDS domain, 0 to 230")
      ->capture_default_str()
      ->check(CLI::Range(0U, 230U))
      ->take_last()
      ->type_name("N");
  app.add_option("--interface", context.connection.interface, "Network interface; default: loopback only")
      ->take_last()
      ->type_name("NAME");
  app.add_option("--session", context.session, "Name of the session; default: the first one found")
      ->take_last()
      ->type_name("NAME");
  app.add_flag("--json", context.json, "Print JSON")->disable_flag_override();
  app.add_option("--timeout", context.timeout_s, "Seconds to wait for the session and for its answer, 0 to 86400")
      ->capture_default_str()
      ->check(finiteIn(0.0, 86400.0))
      ->take_last()
      ->type_name("S");
}

/// Which command is missing or unknown; CLI11 only says that one is required.
std::string missingCommand(const CLI::App& app, const CLI::App& group) {
  std::string known;
  for (const CLI::App* command : group.get_subcommands([](const CLI::App*) { return true; })) {
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return fmt::format("which command? There are {}", known);
  if (unknown.front().starts_with('-')) return fmt::format("there is no option '{}', and no command was given", unknown.front());
  return fmt::format("there is no command '{}'; there are {}", unknown.front(), known);
}

/// CLI11's message and where help is to be found. CLI11 answers help and version through exceptions, too.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string path = "bleedctl";
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    path += " " + command->get_name();
  }
  const bool incomplete = command->get_require_subcommand_min() > 0;
  fmt::print(stderr, "bleedctl: {}\nSee '{} --help' for what is possible.\n",
             incomplete && error.get_name() == "RequiredError" ? missingCommand(app, *command) : error.what(), path);
  return kUsage;
}

}  // namespace

int runBleedctl(int argc, const char* const* argv) {
  Context context;
  CLI::App app{"Controls, watches and records bleedsim sessions.", "bleedctl"};
  app.set_version_flag("--version", std::string{"bleedctl "} + BLEEDSIM_VERSION);
  app.fallthrough();  // inherited by the commands: global options may stand after them
  app.require_subcommand(1);
  app.footer(std::string{kGlobalOptionsText} + kExitCodeText);
  addGlobalOptions(app, context);
  addSessionCommands(app, context);
  addRecordingCommands(app, context);
  addWoundCommands(app, context);
  addEffectCommands(app, context);
  addControlCommands(app, context);
  addLeaseCommand(app, context);
  addCheckpointCommands(app, context);
  addDoctorCommand(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) { return explain(app, error); }
  endOnStopSignals();
  return context.action();
}

}  // namespace bleedsim::bleedctl
