// A world that hands everything on to another one: what a test's own world differs in, it overrides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "service/sph/world.h"

namespace bleedsim::test {

class ForwardingWorld : public sph::World {
 public:
  explicit ForwardingWorld(std::unique_ptr<sph::World> real) : real_{std::move(real)} {}

  Result<sph::Applied> apply(const sph::Command& command) override { return real_->apply(command); }
  Status checkWound(const sph::Command& command) const override { return real_->checkWound(command); }
  Status step(double dt_limit) override { return real_->step(dt_limit); }
  std::uint64_t stepCount() const override { return real_->stepCount(); }
  double time() const override { return real_->time(); }
  std::uint32_t particleCount() const override { return real_->particleCount(); }
  void collectStats(sph::WorldStats& stats) const override { real_->collectStats(stats); }
  std::span<const sph::WoundState> wounds() const override { return real_->wounds(); }
  void copyFrame(sph::FrameBuffer& frame, std::uint32_t attributes) const override { real_->copyFrame(frame, attributes); }
  std::uint64_t stateHash() const override { return real_->stateHash(); }
  Status adopt(sph::World& from) override { return real_->adopt(from); }
  std::size_t stateBytes() const override { return real_->stateBytes(); }
  std::size_t saveState(std::span<std::byte> room) const override { return real_->saveState(room); }
  Status restoreState(std::span<const std::byte> state) override { return real_->restoreState(state); }
  std::string_view woundName(std::uint32_t id) const override { return real_->woundName(id); }
  const sph::WorldDescription& description() const override { return real_->description(); }
  sph::SimdTarget simdTarget() const override { return real_->simdTarget(); }
  double speedOfSound() const override { return real_->speedOfSound(); }
  double particleMass() const override { return real_->particleMass(); }
  bool faulted() const override { return real_->faulted(); }
  sph::MemoryUse memory() const override { return real_->memory(); }
  sph::RunningCode runningCode() const override { return real_->runningCode(); }

 private:
  std::unique_ptr<sph::World> real_;
};

}  // namespace bleedsim::test
