// The checkpoints of one session: a folder that one process at a time writes into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "service/checkpoint/checkpoint.h"
#include "service/status/status.h"

namespace bleedsim::checkpoint {

/// One file of the folder.
struct Entry {
  std::string name;
  std::uint64_t bytes = 0;
  Status readable;  ///< of the head; what follows it shows when it is read
  Head head;        ///< if readable
};

/// One thread writes; what is const may be called from others meanwhile, and then sees each file as it was or as it is now. Files
/// are NAME.bleedstate.
class Folder {
 public:
  static constexpr std::size_t kAutomaticKept = 3;
  static constexpr std::size_t kMaxNamed = 16;

  /// Creates the folder where it is missing, clears away what a killed process was writing, and keeps others out until the end.
  /// io: the folder cannot be made or written into; unavailable: another process has it.
  static Result<Folder> open(const std::filesystem::path& path);
  Folder(Folder&& other) noexcept;
  Folder& operator=(Folder&&) = delete;
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  const std::filesystem::path& path() const { return path_; }

  /// Writes a checkpoint under its name, in place of one of the same name, and deletes the oldest automatic ones beyond
  /// kAutomaticKept. An empty name is an automatic one. Gives the head its serial and name. invalid_argument: the name; capacity:
  /// kMaxNamed others are there; io.
  Status write(Head& head, std::span<const std::byte> state);

  /// invalid_argument: the name; not_found, data_loss, unsupported, io. The message names the checkpoint.
  Result<Checkpoint> read(const std::string& name) const;

  /// The newest first; those whose head cannot be read come last.
  std::vector<Entry> list() const;

 private:
  explicit Folder(std::filesystem::path path, int lock) : path_{std::move(path)}, lock_{lock} {}

  std::filesystem::path fileOf(const std::string& name) const;
  void clearParts() const;
  void deleteOld() const;

  std::filesystem::path path_;
  int lock_;
  std::uint64_t last_serial_ = 0;
};

/// "checkpoint 'x': what"
Status aboutCheckpoint(const std::string& name, const Status& what);

}  // namespace bleedsim::checkpoint
