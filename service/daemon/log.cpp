#include "service/daemon/log.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <string_view>
#include <utility>

namespace bleedsim::daemon {
namespace {

constexpr std::array<std::string_view, 6> kLevels{"trace", "debug", "info", "warning", "error", "off"};

}  // namespace

Status checkLogLevel(const std::string& level) {
  if (std::find(kLevels.begin(), kLevels.end(), level) != kLevels.end()) return {};
  return {StatusCode::invalid_argument, fmt::format("log level '{}': use {}", level, fmt::join(kLevels, ", "))};
}

Result<std::shared_ptr<LogFile>> setUpLog(const LogOptions& options) {
  std::shared_ptr<LogFile> file;
  if (options.file) {
    Result<std::shared_ptr<LogFile>> opened = LogFile::open(*options.file);
    if (!opened) return opened;
    file = std::move(*opened);
  }
  auto standard_error = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  auto logger = std::make_shared<spdlog::logger>("bleedd", standard_error);
  if (file) {
    standard_error->set_level(spdlog::level::warn);
    logger->sinks().push_back(file);
  }
  logger->set_level(spdlog::level::from_str(options.level));
  spdlog::set_default_logger(std::move(logger));
  return file;
}

}  // namespace bleedsim::daemon
