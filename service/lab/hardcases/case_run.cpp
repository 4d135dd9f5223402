#include "service/lab/hardcases/case_run.h"

#include <algorithm>

#include "service/lab/hardcases/every_effect.h"

namespace bleedsim::lab {

Trial::Trial(std::unique_ptr<sph::World> world, HardOutcome& outcome, Always& always)
    : world_{std::move(world)}, outcome_{outcome}, watch_{*world_, always} {}

Trial::~Trial() {
  const sph::WorldStats last = stats();
  for (std::size_t k = 0; k < outcome_.counters.size(); ++k) outcome_.counters[k] += last.counters[k];
}

bool Trial::step(double limit) {
  if (const Status status = world_->step(limit); !status.ok()) {
    outcome_.stopped = status.message();
    return false;
  }
  watch_.check(*world_);
  return true;
}

bool Trial::runFor(double seconds, const std::function<void()>& each) {
  const double end = world_->time() + seconds;
  while (world_->time() < end) {
    if (!step()) return false;
    each();
  }
  return true;
}

bool Trial::runSteps(int steps, const std::function<void()>& each) {
  for (int k = 0; k < steps; ++k) {
    if (!step()) return false;
    each();
  }
  return true;
}

bool Trial::apply(const sph::Command& command) {
  const auto applied = world_->apply(command);
  if (!applied) outcome_.stopped = applied.status().message();
  return applied.ok();
}

bool Trial::change(std::unique_ptr<sph::World> world) {
  if (world == nullptr) return false;
  if (const Status status = world->adopt(*world_); !status.ok()) {
    outcome_.stopped = status.message();
    return false;
  }
  world_ = std::move(world);
  return true;
}

sph::WorldStats Trial::stats() const {
  sph::WorldStats stats;
  world_->collectStats(stats);
  return stats;
}

std::uint64_t Trial::counted(sph::Counter counter) const { return stats().counters[static_cast<std::size_t>(counter)]; }

sph::WorldDescription CaseRun::prepared(sph::WorldDescription scene) const {
  scene.model = setup_.model;
  if (all()) addEveryEffect(scene);
  return scene;
}

std::unique_ptr<sph::World> CaseRun::build(const sph::WorldDescription& prepared_scene, int threads) {
  auto world = sph::createWorld(prepared_scene, {.threads = threads, .precision = setup_.precision});
  if (world) return std::move(*world);
  outcome_.stopped = world.status().message();
  return nullptr;
}

std::unique_ptr<Trial> CaseRun::start(const sph::WorldDescription& scene, int threads) {
  auto world = build(prepared(scene), threads);
  return world ? std::make_unique<Trial>(std::move(world), outcome_, always_) : nullptr;
}

void CaseRun::atMost(std::string name, double value, double bound) {
  within(std::move(name), value, -std::numeric_limits<double>::infinity(), bound);
}

void CaseRun::atLeast(std::string name, double value, double bound) {
  within(std::move(name), value, bound, std::numeric_limits<double>::infinity());
}

void CaseRun::within(std::string name, double value, double lowest, double highest) {
  outcome_.figures.push_back({std::move(name), value, lowest, highest, true});
}

void CaseRun::told(std::string name, double value) { outcome_.figures.push_back({std::move(name), value, 0.0, 0.0, false}); }

HardOutcome CaseRun::finish() && {
  outcome_.always = always_.figures();
  return std::move(outcome_);
}

}  // namespace bleedsim::lab
