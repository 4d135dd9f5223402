// bleedd: a scene in, blood out over DDS.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "service/daemon/program.h"

int main(int argc, char** argv) {
  using namespace bleedsim::daemon;
  spdlog::set_default_logger(spdlog::stderr_color_mt("bleedd"));

  const std::variant<Options, ExitCode> parsed = parseOptions(argc, argv);
  if (const auto* code = std::get_if<ExitCode>(&parsed)) return static_cast<int>(*code);

  const auto signals = SignalWatch::create();
  if (!signals) {
    spdlog::error("{}", signals.status().message());
    return static_cast<int>(ExitCode::failure);
  }
  return static_cast<int>(runProgram(std::get<Options>(parsed), **signals));
}
