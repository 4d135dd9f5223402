#include "clients/bleedctl/file_failure.h"

#include <cstdio>
#include <fmt/core.h>

#include "clients/bleedctl/context.h"
#include "service/recording/recover.h"

namespace bleedsim::bleedctl {

std::string remedyFor(const std::string& path) {
  return fmt::format("'bleedctl recover {} -o OUT' makes a complete file of what it holds", path);
}

int failOnRecording(const Status& status, const std::string& path) {
  if (status.code() == StatusCode::invalid_argument) return fail(kUsage, status.message());
  if (status.code() != StatusCode::data_loss || !recording::isRecoverable(path)) return fail(kFile, status.message());
  return fail(kFile, fmt::format("{}; {}", status.message(), remedyFor(path)));
}

void warnOfCut(const std::string& path, const std::string& truncation_reason) {
  if (truncation_reason.empty()) return;
  fmt::print(stderr, "warning: '{}' was cut off: {}; {}\n", path, truncation_reason, remedyFor(path));
}

}  // namespace bleedsim::bleedctl
