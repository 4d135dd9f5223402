#include "service/recording/file_source.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace bleedsim::recording {
namespace {

::bleedsim::Status cannotRead(const std::filesystem::path& path, int error) {
  const StatusCode code = error == ENOENT ? StatusCode::not_found : StatusCode::io;
  return {code, fmt::format("cannot read '{}': {}; check the path and its permissions", path.string(),
                            std::generic_category().message(error))};
}

}  // namespace

Result<FileSource> FileSource::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return cannotRead(path, errno);
  struct stat info {};
  const int error = ::fstat(descriptor, &info) == 0 ? 0 : errno;
  if (error != 0 || !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    if (error != 0) return cannotRead(path, error);
    return ::bleedsim::Status{StatusCode::io,
                              fmt::format("cannot read '{}': it is not a regular file; give a recording", path.string())};
  }
  return FileSource{path, descriptor, static_cast<std::uint64_t>(info.st_size)};
}

FileSource::FileSource(std::filesystem::path path, int descriptor, std::uint64_t bytes)
    : path_{std::move(path)}, descriptor_{descriptor}, bytes_{bytes} {}

FileSource::FileSource(FileSource&& other) noexcept
    : path_{std::move(other.path_)}, descriptor_{std::exchange(other.descriptor_, -1)}, bytes_{other.bytes_} {}

FileSource& FileSource::operator=(FileSource&& other) noexcept {
  if (this != &other) {
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ = std::move(other.path_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    bytes_ = other.bytes_;
  }
  return *this;
}

FileSource::~FileSource() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

::bleedsim::Status FileSource::read(std::uint64_t offset, std::span<std::byte> out) const {
  while (!out.empty()) {
    const ssize_t got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
    if (got < 0) {
      if (errno == EINTR) continue;
      return cannotRead(path_, errno);
    }
    if (got == 0) return {StatusCode::data_loss, fmt::format("'{}' ends at byte {}, in the middle of a record", name(), offset)};
    out = out.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
  return {};
}

}  // namespace bleedsim::recording
