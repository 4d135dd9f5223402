// The command line: global options, commands, messages about wrong use.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/core.h>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/stop_signal.h"

namespace bleedsim::bleedctl {
namespace {

void addGlobalOptions(CLI::App& app, Context& context) {
  app.add_option("--domain", context.connection.domain, "DDS domain, 0 to 230")
      ->capture_default_str()
      ->check(CLI::Range(0U, 230U));
  app.add_option("--interface", context.connection.interface, "Network interface; default: loopback only");
  app.add_option("--session", context.session, "Name of the session; default: the first one found");
  app.add_flag("--json", context.json, "Print JSON");
  app.add_option("--timeout", context.timeout_s, "Seconds to wait for the session and for its answer")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 86400.0));
}

/// CLI11's message and where help is to be found. CLI11 answers help and version through exceptions, too.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  std::string command;
  for (const CLI::App* a = &app; a != nullptr;) {
    const auto named = a->get_subcommands();
    a = named.empty() ? nullptr : named.front();
    if (a != nullptr) command += " " + a->get_name();
  }
  fmt::print(stderr, "bleedctl: {}\nSee 'bleedctl{} --help' for what is possible.\n", error.what(), command);
  return kUsage;
}

}  // namespace

int runBleedctl(int argc, const char* const* argv) {
  Context context;
  CLI::App app{"Controls, watches and records bleedsim sessions.", "bleedctl"};
  app.set_version_flag("--version", std::string{"bleedctl "} + BLEEDSIM_VERSION);
  app.fallthrough();  // inherited by the commands: global options may stand after them
  app.require_subcommand(1);
  app.footer(std::string{"Global options stand before or after the command. Positions are in metres.\n\n"} + kExitCodeText);
  addGlobalOptions(app, context);
  addSessionCommands(app, context);
  if constexpr (BLEEDSIM_WITH_RECORDING) addRecordingCommands(app, context);
  addWoundCommands(app, context);
  addControlCommands(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) { return explain(app, error); }
  blockStopSignals();
  return context.action();
}

}  // namespace bleedsim::bleedctl
