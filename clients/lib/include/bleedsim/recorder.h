// Records a session into an MCAP file while it runs: frames, statistics, status, scene and the journal of its inputs.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bleedsim/client.h"

namespace bleedsim::client {

/// When to end, and how densely to record; unset: until close(), every frame.
struct RecordingLimits {
  std::optional<double> duration_s{};     ///< simulated time from the first frame
  std::optional<std::uint64_t> frames{};  ///< recorded frames
  std::optional<double> rate_hz{};        ///< at most so many frames per simulated second
};

enum class Compression { none, lz4, zstd };

/// How frames are stored. Everything else is always stored as it came.
struct RecordingFormat {
  Compression compression = Compression::zstd;
  /// Numbers of frames in 16 bits, over the range of each attribute in each frame; ids stay exact. The file states the error.
  bool quantize16 = false;
  /// Each frame once more as a foxglove.PointCloud, which Foxglove and Lichtblick draw.
  bool point_cloud = false;
};

struct RecordingProgress {
  std::uint64_t frames = 0;
  std::uint64_t gaps = 0;                      ///< frames lost on the way
  std::uint64_t malformed = 0;                 ///< samples that contradicted themselves, left out
  std::uint32_t particles = 0;                 ///< of the last frame
  double recorded_s = 0.0;                     ///< simulated, over all epochs
  std::uint64_t bytes = 0;                     ///< in the file so far
  bool done = false;                           ///< a limit is reached, the session is gone, the file or the middleware failed
  bool complete = false;                       ///< a limit is reached
  bool session_gone = false;                   ///< `state` is stopped when it said so, else it was lost
  bool replaced = false;                       ///< a later daemon of the same name was heard; nothing of it is recorded
  SessionState state = SessionState::unknown;  ///< of the last status; frames come while it is running
  std::string state_text{};                    ///< what the session says about it
  std::string failure{};                       ///< why file or middleware failed, before close() says so; empty: they did not
  std::string buffer_warning{};                ///< why frames may be lost on this host; empty: nothing speaks for it
};

/// Move-only, thread-safe. Reads reliably with a deep history on a thread of its own. It belongs to one daemon: when that is
/// gone, the recording has ended, and another daemon of the same session name never comes into the file. At the end it waits up
/// to a second for what is still being resent: the last frame, its statistics and its inputs.
class Recorder {
 public:
  /// The session has to exist: see Client::find. Of several daemons that the client knows under the name, the one that started
  /// last is recorded. io: the file cannot be created; unavailable: the middleware refused.
  static Result<Recorder> start(Client& client, const std::string& session, const std::string& path,
                                const RecordingLimits& limits, const RecordingFormat& format = {});
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  /// Closes the file; call close() to learn whether that worked.
  ~Recorder();

  RecordingProgress progress() const;
  /// Waits until progress().done; false: not yet.
  bool waitDone(std::chrono::nanoseconds timeout);
  /// Ends the recording, writes the index and closes the file. Further calls give the first answer. io: the file could not be
  /// written; unavailable: the middleware failed, the file holds what came until then.
  Status close();

 private:
  class Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::client
