// A file of any bytes: reading it ends, and what recover() makes of it is a whole recording.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "service/recording/recording_reader.h"
#include "service/recording/recover.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace bleedsim;

/// Names of this process, in memory where the system has such a folder.
std::filesystem::path scratch(const char* name) {
  const std::filesystem::path memory{"/dev/shm"};
  const std::filesystem::path folder = std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path();
  return folder / ("bleedsim_fuzz_" + std::to_string(getpid()) + name);
}

struct Files {
  std::filesystem::path in = scratch(".mcap");
  std::filesystem::path out = scratch("_out.mcap");
  ~Files() {
    std::filesystem::remove(in);
    std::filesystem::remove(out);
  }
};

/// Every message, decoded as its topic says; false when the reading ended with an error.
bool readThrough(recording::RecordingReader& reader) {
  recording::RecordedMessage message;
  recording::Frame frame;
  recording::FrameStats stats;
  recording::Journal journal;
  recording::Scene scene;
  recording::Status status;
  for (;;) {
    const Result<bool> more = reader.next(message);
    if (!more) return false;
    if (!*more) return true;
    static_cast<void>(recording::decode(message, frame));
    static_cast<void>(recording::decode(message, stats));
    static_cast<void>(recording::decode(message, journal));
    static_cast<void>(recording::decode(message, scene));
    static_cast<void>(recording::decode(message, status));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Files files;
  std::ofstream{files.in, std::ios::binary | std::ios::trunc}.write(reinterpret_cast<const char*>(data),
                                                                    static_cast<std::streamsize>(size));
  if (Result<recording::RecordingReader> reader = recording::RecordingReader::open(files.in); reader.ok()) {
    static_cast<void>(reader->verify());
    static_cast<void>(readThrough(*reader));
    if (const Result<std::size_t> frames = reader->frameCount(); frames.ok() && *frames > 0) {
      recording::Frame frame;
      static_cast<void>(reader->frame(*frames - 1, frame));
    }
  }
  static_cast<void>(recording::isRecoverable(files.in));
  const Result<recording::RecoverReport> report = recording::recover(files.in, files.out);
  if (!report) {
    fuzz::require(!report.status().message().empty(), "a refusal has a reason");
    return 0;
  }
  Result<recording::RecordingReader> recovered = recording::RecordingReader::open(files.out);
  fuzz::require(recovered.ok(), "a recovered file opens");
  fuzz::require(!recovered->truncated(), "a recovered file is whole");
  fuzz::require(recovered->verify().ok(), "a recovered file has its checksum");
  fuzz::require(readThrough(*recovered), "a recovered file can be read to its end");
  return 0;
}
