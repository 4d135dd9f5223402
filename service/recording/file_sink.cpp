#include "service/recording/file_sink.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <utility>

#include "service/status/file_error.h"

namespace bleedsim::recording {

Result<FileSink> FileSink::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    const int error = errno;
    return ::bleedsim::Status{StatusCode::io, fmt::format("cannot create '{}': {}", path.string(), fileErrorText(error))};
  }
  return FileSink{path, descriptor};
}

FileSink::FileSink(FileSink&& other) noexcept
    : path_{std::move(other.path_)},
      descriptor_{std::exchange(other.descriptor_, -1)},
      bytes_{other.bytes_},
      status_{std::move(other.status_)} {}

FileSink& FileSink::operator=(FileSink&& other) noexcept {
  if (this != &other) {
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ = std::move(other.path_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    bytes_ = other.bytes_;
    status_ = std::move(other.status_);
  }
  return *this;
}

FileSink::~FileSink() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

::bleedsim::Status FileSink::fail(int error, const char* action) {
  status_ = {StatusCode::io, fmt::format("cannot {} '{}': {}", action, path_.string(), fileErrorText(error))};
  return status_;
}

::bleedsim::Status FileSink::write(std::string_view bytes) {
  if (!status_.ok()) return status_;
  if (descriptor_ < 0) return {StatusCode::wrong_state, fmt::format("'{}' is closed", path_.string())};
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return fail(errno, "write to");
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    bytes_ += static_cast<std::uint64_t>(written);
  }
  return {};
}

::bleedsim::Status FileSink::close() {
  if (descriptor_ < 0) return status_;
  // Pipes and some file systems cannot sync; only a real failure to store counts.
  const int error = ::fsync(descriptor_) == 0 ? 0 : errno;
  return closeAfter(error == EINVAL || error == ENOTSUP || error == EROFS ? 0 : error);
}

::bleedsim::Status FileSink::closeQuickly() { return descriptor_ < 0 ? status_ : closeAfter(0); }

::bleedsim::Status FileSink::closeAfter(int sync_error) {
  const int close_error = ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
  if (!status_.ok()) return status_;
  if (sync_error != 0) return fail(sync_error, "store");
  if (close_error != 0 && close_error != EINTR) return fail(close_error, "close");
  return {};
}

}  // namespace bleedsim::recording
