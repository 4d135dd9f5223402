// A real world whose solver stops when a test says so, as it does by itself on numbers that are not finite.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "tests/support/forwarding_world.h"

namespace bleedsim::service_test {

class FaultingWorld final : public test::ForwardingWorld {
 public:
  FaultingWorld(std::unique_ptr<sph::World> real, const std::atomic<bool>& faults)
      : ForwardingWorld{std::move(real)}, faults_{faults} {}

  Status step(double dt_limit) override {
    if (!faults_) return ForwardingWorld::step(dt_limit);
    faulted_ = true;
    return {StatusCode::internal, "the velocity of particle 7 is not finite"};
  }
  bool faulted() const override { return faulted_; }

 private:
  const std::atomic<bool>& faults_;
  bool faulted_ = false;
};

}  // namespace bleedsim::service_test
