// Random messages of every kind, and recordings made of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "idl/recording.pb.h"
#include "service/recording/topics.h"

namespace bleedsim::recording::test {

/// A file in the tests' temporary directory, removed with the object.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name);
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string readAll(const std::filesystem::path& path);
void writeAll(const std::filesystem::path& path, const std::string& bytes);

/// Fills every member, whatever its kind; strings are short, identities have 16 bytes, lists up to 5 entries.
void randomize(std::mt19937_64& random, google::protobuf::Message& message);
/// A frame with positions, ids and 16-bit scaled velocities.
Frame makeFrame(std::mt19937_64& random, std::uint64_t seq, std::uint32_t count);
Scene makeScene(std::mt19937_64& random);
/// Cases of a request, and of a journal entry with each request counted for itself.
constexpr int kRequestKinds = 18;
constexpr int kJournalKinds = kRequestKinds + 5;
/// Kind 0 to kJournalKinds - 1: every case of a request, and the other bodies.
Journal makeJournal(std::mt19937_64& random, std::uint64_t number, int kind);
FrameStats makeStats(std::uint64_t seq, double emitted_ml);

struct Stored {
  Topic topic;
  std::string bytes;
};
/// Writes `frames` frames with statistics, a scene and journal entries; gives back what was written, in order.
std::vector<Stored> writeRecording(const std::filesystem::path& path, std::size_t frames, std::size_t chunk_bytes);

}  // namespace bleedsim::recording::test
