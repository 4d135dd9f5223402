#include "service/lab/progress.h"

#include <cstdio>
#include <fmt/core.h>
#include <unistd.h>

namespace bleedsim::lab {

Progress::Progress(std::string name) : name_{std::move(name)}, terminal_{isatty(STDERR_FILENO) == 1} {}

Progress::~Progress() {
  if (terminal_ && shown_ >= 0) fmt::print(stderr, "\n");
}

void Progress::report(double part) {
  const int percent = static_cast<int>(100.0 * part);
  if (!terminal_ || percent == shown_) return;
  shown_ = percent;
  fmt::print(stderr, "\r{}: {:3} %", name_, percent);
  std::fflush(stderr);
}

}  // namespace bleedsim::lab
