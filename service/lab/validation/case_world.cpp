#include "service/lab/validation/case_world.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace bleedsim::lab {
namespace {

double wallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double processSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Result<CaseWorld> CaseWorld::create(sph::WorldDescription scene, const Knobs& knobs, RunCost& cost) {
  auto world = sph::createWorld(scene, knobs.options());
  if (!world) return world.status();
  if (knobs.cfl < kStableCfl) {
    if (Status status = (*world)->step(std::numeric_limits<double>::infinity()); !status.ok()) return status;
    scene.max_dt = statsOf(**world).dt * knobs.cfl / kStableCfl;
    world = sph::createWorld(scene, knobs.options());
    if (!world) return world.status();
  }
  return CaseWorld{std::move(*world), cost};
}

Status CaseWorld::step(double limit) {
  const double wall = wallSeconds();
  const double cpu = processSeconds();
  const double before = world_->time();
  if (Status status = world_->step(limit); !status.ok()) return status;
  const double took = wallSeconds() - wall;
  cost_->all_wall += took;
  cost_->particles = std::max(cost_->particles, world_->particleCount());
  if (world_->stepCount() <= kWarmUpSteps) return {};
  cost_->cpu += processSeconds() - cpu;
  cost_->wall += took;
  ++cost_->steps;
  cost_->particle_steps += world_->particleCount();
  cost_->simulated += world_->time() - before;
  return {};
}

Status CaseWorld::runFor(double seconds, const std::function<void()>& each) {
  const double end = world_->time() + seconds;
  while (end - world_->time() > 1e-12 * end) {
    if (Status status = step(end - world_->time()); !status.ok()) return status;
    if (each) each();
  }
  const sph::WorldStats now = stats();
  const auto counted = [&](sph::Counter counter) { return now.counters[static_cast<std::size_t>(counter)]; };
  const std::uint64_t clamped = counted(sph::Counter::acceleration_clamped) + counted(sph::Counter::speed_clamped);
  cost_->clamped += clamped - clamped_;
  clamped_ = clamped;
  return {};
}

Result<std::vector<sph::Vec3>> accelerationsOf(const sph::WorldDescription& scene, const sph::WorldOptions& options, double dt) {
  auto world = sph::createWorld(scene, options);
  if (!world) return world.status();
  const Frame before = frameOf(**world);
  if (Status status = (*world)->step(dt); !status.ok()) return status;
  const Frame after = frameOf(**world);
  std::vector<sph::Vec3> acceleration(before.size(), sph::Vec3::Zero());
  if (after.size() != before.size()) return Status{StatusCode::internal, "a particle left the domain in the first step"};
  const std::uint32_t least = *std::min_element(before.buffer.id.begin(), before.buffer.id.end());
  for (std::size_t i = 0; i < before.size(); ++i) acceleration.at(before.buffer.id[i] - least) -= before.velocity(i);
  for (std::size_t i = 0; i < after.size(); ++i) acceleration.at(after.buffer.id[i] - least) += after.velocity(i);
  for (sph::Vec3& a : acceleration) a /= (*world)->time();
  return acceleration;
}

}  // namespace bleedsim::lab
