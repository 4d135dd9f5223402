// A world without physics, whose steps a test can predict.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/daemon/scene_loader.h"
#include "service/sph/world.h"

namespace bleedsim::daemon {

/// What a test sees of a fake world.
struct FakeLog {
  std::vector<std::pair<std::uint64_t, sph::Command>> applied;  ///< with the steps that were done
  std::map<sph::ForceKey, sph::SetForce> forces;
  std::uint64_t fail_at_step = 0;                  ///< the step that fails, 0: none
  std::function<void(std::uint64_t)> before_step;  ///< told its number; may hold the step up
  bool refuse_adoption = false;
  int adoptions = 0;
  bool refuse_wounds = false;
  std::optional<scene::Session> session;  ///< that the last switched world was built for
};

class FakeWorld final : public sph::World {
 public:
  static constexpr double kDt = 0.001;  ///< s

  FakeWorld(sph::WorldDescription description, std::shared_ptr<FakeLog> log);

  Result<sph::Applied> apply(const sph::Command& command) override;
  Status checkWound(const sph::Command& command) const override;
  Status step(double dt_limit) override;
  std::uint64_t stepCount() const override { return steps_; }
  double time() const override { return static_cast<double>(steps_) * kDt; }
  std::uint32_t particleCount() const override { return 2; }
  void collectStats(sph::WorldStats& stats) const override;
  std::span<const sph::WoundState> wounds() const override { return wounds_; }
  void copyFrame(sph::FrameBuffer& frame, std::uint32_t attributes) const override;
  std::uint64_t stateHash() const override { return steps_ * 1000 + wounds_.size(); }
  Status adopt(sph::World& from) override;
  std::size_t stateBytes() const override { return 2 * sizeof(std::uint64_t); }
  std::size_t saveState(std::span<std::byte> room) const override;
  Status restoreState(std::span<const std::byte> state) override;
  std::string_view woundName(std::uint32_t id) const override;
  sph::MemoryUse memory() const override { return {}; }
  sph::RunningCode runningCode() const override { return {}; }
  const sph::WorldDescription& description() const override { return description_; }
  sph::SimdTarget simdTarget() const override { return sph::SimdTarget::scalar; }
  double speedOfSound() const override { return 3.0; }
  double particleMass() const override { return 1e-6; }
  bool faulted() const override { return faulted_; }

 private:
  sph::WorldDescription description_;
  std::shared_ptr<FakeLog> log_;
  std::vector<sph::WoundState> wounds_;
  std::uint64_t steps_ = 0;
  bool faulted_ = false;
};

/// A scene of that name with a fake world; 10 frames per simulated second, instruments expire after 0.1 s.
LoadedScene fakeScene(const std::string& name, std::shared_ptr<FakeLog> log);

/// Loads any text as a scene of that name; "broken" has problems, a known scene is made anew. Effects of any name are switched;
/// the settings "bad" are refused, "decide" bring a decision. effects.auto has left surface_tension out of the scene "no tension"
/// for wounds above 5 mm, and leaves nothing else to decide; of "stuck", it cannot bring it back.
SceneFactory fakeFactory(std::shared_ptr<FakeLog> log);

}  // namespace bleedsim::daemon
