// bleedd: a scene in, blood out over DDS.
#include <spdlog/spdlog.h>

#include "service/daemon/program.h"

int main(int argc, char** argv) {
  using namespace bleedsim::daemon;
  const std::variant<Options, ExitCode> parsed = parseOptions(argc, argv);
  if (const auto* code = std::get_if<ExitCode>(&parsed)) return static_cast<int>(*code);
  const auto& options = std::get<Options>(parsed);

  const auto log_file = setUpLog(options.log);
  if (!log_file) {
    spdlog::error("{}", log_file.status().message());
    return static_cast<int>(ExitCode::usage);
  }
  const auto signals = SignalWatch::create();
  if (!signals) {
    spdlog::error("{}", signals.status().message());
    return static_cast<int>(ExitCode::failure);
  }
  return static_cast<int>(runProgram(options, *log_file, **signals));
}
