// A world that a case runs, at the time step that its knobs ask for, with what the steps cost.
#pragma once

#include <functional>
#include <memory>

#include "service/lab/validation/case.h"
#include "service/lab/validation/measure.h"

namespace bleedsim::lab {

/// After so many steps of a world its cost counts: lists, radii and caches are then those of the run.
inline constexpr int kWarmUpSteps = 20;

class CaseWorld {
 public:
  /// `cost` must outlive the world.
  static Result<CaseWorld> create(sph::WorldDescription scene, const Knobs& knobs, RunCost& cost);

  /// Until exactly `seconds` have passed; `each` runs after every step. Fails if the solver does. What the solver had to cut
  /// goes to the cost.
  Status runFor(double seconds, const std::function<void()>& each = {});
  /// One step of at most `limit` s.
  Status step(double limit);

  const sph::World& operator*() const { return *world_; }
  const sph::World* operator->() const { return world_.get(); }
  Frame frame() const { return frameOf(*world_); }
  sph::WorldStats stats() const { return statsOf(*world_); }
  std::uint64_t counter(sph::Counter counter) const { return stats().counters[static_cast<std::size_t>(counter)]; }

 private:
  CaseWorld(std::unique_ptr<sph::World> world, RunCost& cost) : world_{std::move(world)}, cost_{&cost} {}

  std::unique_ptr<sph::World> world_;
  RunCost* cost_;
  std::uint64_t clamped_ = 0;  // of the cost's, those of this world
};

/// Accelerations of the scene's particles as they stand, m/s^2, by id: velocities after one step of `dt` s that moves nothing
/// noticeably.
Result<std::vector<sph::Vec3>> accelerationsOf(const sph::WorldDescription& scene, const sph::WorldOptions& options, double dt);

}  // namespace bleedsim::lab
