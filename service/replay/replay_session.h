// A session without a service: a world, and what inputs mean in it. Inputs act here as service/daemon/simulation lets them act.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "idl/recording.pb.h"
#include "service/checkpoint/checkpoint.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::replay {

/// A session as it was between two steps.
struct Snapshot {
  std::shared_ptr<const scene::SceneDescription> scene;
  std::vector<std::byte> state;
  std::uint64_t hash = 0;
  double speed_of_sound = 0.0;   ///< m/s
  double narrowest_wound = 0.0;  ///< m
  std::uint64_t next_force_key = 1;
  std::uint64_t next_tool_key = 0;
  std::map<std::pair<std::string, std::uint32_t>, std::uint64_t> tools;  ///< force keys by client and tool
};

class ReplaySession {
 public:
  /// From the beginning of a scene. Errors as scene::parseScene and sph::createWorld.
  static Result<ReplaySession> begin(const std::string& scene_text, const sph::WorldOptions& options);
  /// Errors as sph::createWorld and restoreState.
  static Result<ReplaySession> goOn(const Snapshot& snapshot, const sph::WorldOptions& options);
  /// As checkpoint::rebuild.
  static Result<ReplaySession> goOn(const checkpoint::Checkpoint& checkpoint, const sph::WorldOptions& options);

  /// Lets an entry of a journal act. data_loss: it cannot be read; else the world's refusal, which means that the state is not
  /// the one in which it was taken.
  Status apply(const recording::Journal& entry);

  Snapshot snapshot() const;
  sph::World& world() { return *world_; }
  const sph::World& world() const { return *world_; }
  const scene::SceneDescription& scene() const { return *scene_; }

 private:
  ReplaySession(std::shared_ptr<const scene::SceneDescription> scene, std::unique_ptr<sph::World> world,
                const sph::WorldOptions& options);

  Status applyRequest(const recording::Journal& entry);
  Status applyInstrument(const recording::Journal& entry);
  Status endInstrument(const recording::InstrumentEnd& end);
  Status command(const sph::Command& command);
  Status takeOver(Result<scene::SceneDescription> scene);

  std::shared_ptr<const scene::SceneDescription> scene_;
  std::unique_ptr<sph::World> world_;
  sph::WorldOptions options_;
  double narrowest_wound_;
  std::optional<double> switch_narrowest_;  // of the effect request that follows
  std::uint64_t next_force_key_ = 1;
  std::uint64_t next_tool_key_;
  std::map<std::pair<std::string, std::uint32_t>, std::uint64_t> tools_;
};

}  // namespace bleedsim::replay
