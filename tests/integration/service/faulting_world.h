// A real world whose solver stops when a test says so, as it does by itself on numbers that are not finite.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "service/sph/world.h"

namespace bleedsim::service_test {

class FaultingWorld final : public sph::World {
 public:
  FaultingWorld(std::unique_ptr<sph::World> real, const std::atomic<bool>& faults) : real_{std::move(real)}, faults_{faults} {}

  Status step(double dt_limit) override {
    if (!faults_) return real_->step(dt_limit);
    faulted_ = true;
    return {StatusCode::internal, "the velocity of particle 7 is not finite"};
  }
  bool faulted() const override { return faulted_; }

  Result<sph::Applied> apply(const sph::Command& command) override { return real_->apply(command); }
  Status checkWound(const sph::Command& command) const override { return real_->checkWound(command); }
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
  sph::MemoryUse memory() const override { return real_->memory(); }
  sph::RunningCode runningCode() const override { return real_->runningCode(); }
  const sph::WorldDescription& description() const override { return real_->description(); }
  sph::SimdTarget simdTarget() const override { return real_->simdTarget(); }
  double speedOfSound() const override { return real_->speedOfSound(); }
  double particleMass() const override { return real_->particleMass(); }

 private:
  std::unique_ptr<sph::World> real_;
  const std::atomic<bool>& faults_;
  bool faulted_ = false;
};

}  // namespace bleedsim::service_test
