#include "service/checkpoint/atomic_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace bleedsim::checkpoint {
namespace {

/// Closes what was opened.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_{value} {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int value() const { return value_; }
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

Status failed(const char* what, const std::filesystem::path& path) {
  return {StatusCode::io, fmt::format("cannot {} '{}': {}", what, path.string(), std::generic_category().message(errno))};
}

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

Status writePart(const std::filesystem::path& part, std::initializer_list<std::span<const std::byte>> parts) {
  Descriptor file{::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0640)};
  if (file.value() < 0) return failed("create", part);
  for (const std::span<const std::byte> bytes : parts) {
    if (!writeAll(file.value(), bytes)) return failed("write", part);
  }
  if (::fsync(file.value()) != 0) return failed("bring to the disk", part);
  if (!file.close()) return failed("close", part);
  return {};
}

}  // namespace

Status writeAtomically(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts) {
  std::filesystem::path part = path;
  part += kPartSuffix;
  Status written = writePart(part, parts);
  if (written && ::rename(part.c_str(), path.c_str()) != 0) written = failed("create", path);
  if (!written) {
    ::unlink(part.c_str());
    return written;
  }
  const Descriptor folder{::open(path.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (folder.value() < 0 || ::fsync(folder.value()) != 0) return failed("bring to the disk", path.parent_path());
  return {};
}

}  // namespace bleedsim::checkpoint
