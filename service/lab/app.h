// bleedlab's command line.
#pragma once

#include <functional>
#include <string>

// NOLINTNEXTLINE(readability-identifier-naming): CLI11 names its namespace
namespace CLI {
class App;
}

namespace bleedsim::lab {

/// Exit codes, documented in --help.
enum class ExitCode : int {
  done = 0,
  missed = 1,   ///< it ran, and what was judged does not hold: a threshold, a hard case, a random scene, a budget
  usage = 2,    ///< wrong command line or scene
  differs = 3,  ///< a recording that was verified is not what its replay gives, or cannot be compared with it
  failed = 4,   ///< the solver refused or failed, or a file cannot be written
};

struct Context {
  std::function<ExitCode()> action;  ///< of the command that was given
};

/// Prints "bleedlab: MESSAGE" to stderr and gives the code back.
ExitCode fail(ExitCode code, const std::string& message);

void addBenchCommand(CLI::App& app, Context& context);
void addEffectsCommand(CLI::App& app, Context& context);
void addHardCasesCommand(CLI::App& app, Context& context);
void addPaperCommand(CLI::App& app, Context& context);
void addReplayCommand(CLI::App& app, Context& context);
void addTortureCommand(CLI::App& app, Context& context);
void addValidateCommand(CLI::App& app, Context& context);
void addAccuracyCommand(CLI::App& app, Context& context);
void addChooseCommand(CLI::App& app, Context& context);

int runLab(int argc, const char* const* argv);

}  // namespace bleedsim::lab
