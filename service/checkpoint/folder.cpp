#include "service/checkpoint/folder.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "service/checkpoint/atomic_file.h"
#include "service/checkpoint/state_file.h"
#include "service/status/checkpoint_name.h"

namespace bleedsim::checkpoint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".bleedstate";
constexpr const char* kLockName = ".lock";

/// The name in a file's name, or nothing.
std::string nameOf(const fs::path& file) {
  const std::string text = file.filename().string();
  if (!text.ends_with(kSuffix)) return {};
  std::string name = text.substr(0, text.size() - kSuffix.size());
  return checkCheckpointName(name) ? name : std::string{};
}

std::string automaticName(std::uint64_t serial) { return fmt::format("auto-{:08}", serial); }

}  // namespace

Status aboutCheckpoint(const std::string& name, const Status& what) {
  return {what.code(), fmt::format("checkpoint '{}': {}", name, what.message())};
}

Result<Folder> Folder::open(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    return Status{StatusCode::io, fmt::format("cannot create the checkpoints' folder '{}': {}; choose one that you may write",
                                              path.string(), error.message())};
  }
  const int lock = ::open((path / kLockName).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640);
  if (lock < 0) {
    return Status{StatusCode::io, fmt::format("cannot write into the checkpoints' folder '{}': {}; choose one that you may write",
                                              path.string(), std::generic_category().message(errno))};
  }
  Folder folder{path, lock};
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    return Status{StatusCode::unavailable,
                  fmt::format("another bleedd writes into the checkpoints' folder '{}': give each its own", path.string())};
  }
  folder.clearParts();
  for (const Entry& entry : folder.list()) folder.last_serial_ = std::max(folder.last_serial_, entry.head.serial);
  return folder;
}

Folder::Folder(Folder&& other) noexcept
    : path_{std::move(other.path_)}, lock_{std::exchange(other.lock_, -1)}, last_serial_{other.last_serial_} {}

Folder::~Folder() {
  if (lock_ >= 0) ::close(lock_);
}

fs::path Folder::fileOf(const std::string& name) const { return path_ / (name + std::string{kSuffix}); }

void Folder::clearParts() const {
  std::error_code ignored;
  for (const fs::directory_entry& file : fs::directory_iterator{path_, ignored}) {
    const fs::path whole = file.path().parent_path() / file.path().stem();
    if (file.path().extension() == kPartSuffix && !nameOf(whole).empty()) fs::remove(file.path(), ignored);
  }
}

Status Folder::write(Head& head, std::span<const std::byte> state) {
  head.serial = last_serial_ + 1;
  // A damaged file has no serial that can be read, but may have its name.
  std::error_code ignored;
  while (head.name.empty() && fs::exists(fileOf(automaticName(head.serial)), ignored)) ++head.serial;
  if (head.name.empty()) head.name = automaticName(head.serial);
  if (Status name = checkCheckpointName(head.name); !name) return name;
  if (!isAutomaticCheckpoint(head.name)) {
    std::size_t others = 0;
    for (const Entry& entry : list()) others += isAutomaticCheckpoint(entry.name) || entry.name == head.name ? 0 : 1;
    if (others >= kMaxNamed) {
      return {StatusCode::capacity,
              fmt::format("there are {} checkpoints with a name: use one of their names, or delete a file", others)};
    }
  }
  if (Status written = writeCheckpoint(fileOf(head.name), head, state); !written) return written;
  last_serial_ = head.serial;
  deleteOld();
  return {};
}

void Folder::deleteOld() const {
  std::size_t automatic = 0;
  for (const Entry& entry : list()) {
    std::error_code ignored;
    if (entry.readable && isAutomaticCheckpoint(entry.name) && ++automatic > kAutomaticKept)
      fs::remove(fileOf(entry.name), ignored);
  }
}

Result<Checkpoint> Folder::read(const std::string& name) const {
  if (Status valid = checkCheckpointName(name); !valid) return valid;
  Result<Checkpoint> read = readCheckpoint(fileOf(name));
  if (!read && read.status().code() == StatusCode::not_found) {
    return Status{StatusCode::not_found, fmt::format("there is no checkpoint '{}'", name)};
  }
  if (!read) return aboutCheckpoint(name, read.status());
  if (read->head.name != name) {
    return aboutCheckpoint(name,
                           {StatusCode::data_loss, fmt::format("it was saved as '{}': a file was renamed", read->head.name)});
  }
  return read;
}

std::vector<Entry> Folder::list() const {
  std::vector<Entry> entries;
  std::error_code ignored;
  for (const fs::directory_entry& file : fs::directory_iterator{path_, ignored}) {
    Entry entry;
    entry.name = nameOf(file.path());
    if (entry.name.empty()) continue;
    entry.bytes = file.file_size(ignored);
    Result<Head> head = readHead(file.path());
    if (head) {
      entry.head = std::move(*head);
    } else {
      entry.readable = head.status();
    }
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair{b.head.serial, b.name} < std::pair{a.head.serial, a.name};
  });
  return entries;
}

}  // namespace bleedsim::checkpoint
