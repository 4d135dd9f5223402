// A session without DDS and without wall time: the daemon's simulation under inputs that the test chooses, recorded into a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "clients/lib/request_builder.h"
#include "service/checkpoint/folder.h"
#include "service/daemon/checkpoint_keeper.h"
#include "service/daemon/simulation.h"
#include "service/dds/frame_encoder.h"
#include "service/dds/session_encoder.h"
#include "service/recording/recording_writer.h"

namespace bleedsim::replay {

/// A wound in flat tissue with every kind of input possible; `effects` beside gravity, pressure, viscosity and applied force.
std::string liveScene(const std::string& effects = {});

class LiveRun {
 public:
  struct Options {
    std::optional<double> checkpoint_every = {};
    std::uint8_t session = 7;  ///< its identity
    int threads = 1;
  };

  /// Records into `file`, keeps checkpoints in `checkpoints`. Begins with the scene or, where that is empty, with the newest
  /// checkpoint.
  LiveRun(const std::string& scene_text, const std::filesystem::path& file, std::shared_ptr<checkpoint::Folder> checkpoints,
          const Options& options);
  LiveRun(const std::string& scene_text, const std::filesystem::path& file, std::shared_ptr<checkpoint::Folder> checkpoints)
      : LiveRun{scene_text, file, std::move(checkpoints), Options{}} {}

  /// Ticks until so many more steps are done.
  void steps(std::uint64_t count);
  /// Asks and ticks until the answer is there.
  dds::Reply ask(const Result<client::RequestPointer>& request);
  void pushTool(std::uint32_t tool, double force_x);
  void loseTools();
  /// Ticks until so many checkpoints are on the disk, however slow it is.
  void awaitCheckpoints(std::uint64_t count);

  /// Ends the recording.
  void close();
  const sph::World& world() const { return simulation_->world(); }
  const daemon::Simulation& simulation() const { return *simulation_; }

 private:
  void tick();
  void record();

  daemon::Channels channels_;
  std::unique_ptr<daemon::CheckpointKeeper> keeper_;
  std::unique_ptr<daemon::Simulation> simulation_;
  daemon::TimePoint now_{std::chrono::seconds{100}};
  dds::SessionIdentity identity_;
  std::unique_ptr<dds::FrameEncoder> frame_encoder_;
  std::unique_ptr<dds::FrameStatsEncoder> stats_encoder_;
  std::unique_ptr<dds::SceneEncoder> scene_encoder_;
  std::optional<recording::RecordingWriter> writer_;
  std::uint64_t frame_seq_ = 0;
  std::uint64_t request_seq_ = 0;
  std::uint64_t sample_seq_ = 0;
};

}  // namespace bleedsim::replay
