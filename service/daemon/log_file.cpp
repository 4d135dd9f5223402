#include "service/daemon/log_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <string_view>
#include <unistd.h>

#include "service/status/file_error.h"

namespace bleedsim::daemon {
namespace {

constexpr mode_t kMode = 0640;

Result<int> openForAppending(const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, kMode);
  if (file >= 0) return file;
  return Status{StatusCode::io, fmt::format("log file '{}' cannot be opened: {}", path, fileErrorText(errno))};
}

/// What is left when the system takes no more.
std::string_view writeAll(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return text;
}

}  // namespace

Result<std::shared_ptr<LogFile>> LogFile::open(const std::string& path) {
  const Result<int> file = openForAppending(path);
  if (!file) return file.status();
  return std::shared_ptr<LogFile>{new LogFile{path, *file}};
}

LogFile::~LogFile() { close(file_); }

Status LogFile::reopen() {
  const Result<int> file = openForAppending(path_);
  if (!file) return file.status();
  const std::lock_guard lock{mutex_};
  close(file_);
  file_ = *file;
  return {};
}

void LogFile::sink_it_(const spdlog::details::log_msg& message) {
  spdlog::memory_buf_t line;
  formatter_->format(message, line);
  std::string text{line.data(), line.size()};
  if (lost_ > 0) text = fmt::format("{}({} lines could not be written here)\n{}", cut_ ? "\n" : "", lost_, text);
  const std::string_view left = writeAll(file_, text);
  if (left.empty()) {
    lost_ = 0;
    cut_ = false;
  } else {
    ++lost_;
    cut_ = cut_ || left.size() < text.size();
  }
}

}  // namespace bleedsim::daemon
