#include "service/lab/torture/torture.h"

#include <fmt/format.h>
#include <optional>

#include "service/lab/hardcases/always.h"
#include "service/lab/hardcases/report.h"
#include "service/scene/change_effect.h"
#include "service/scene/scene.h"
#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::lab {
namespace {

/// The first figure that does not hold.
std::string brokenBy(const Always& always) {
  for (const HardFigure& figure : always.figures()) {
    if (!figure.holds()) return describe(figure);
  }
  return {};
}

/// A limit that is no time is refused and leaves no trace.
bool refusesBadLimit(sph::World& world, double limit) {
  const std::uint64_t before = world.stateHash();
  return !world.step(limit).ok() && world.stateHash() == before && !world.faulted();
}

/// More than half a spacing deep in tissue, or on it and facing it.
bool isBuried(const sph::WorldDescription& scene, const sph::Vec3& position, const std::optional<sph::Vec3>& normal) {
  const double half = 0.5001 * scene.spacing;
  for (const sph::TissueDescription& tissue : scene.tissue) {
    const auto wall = sph::signedDistance(tissue.shape, position);
    const sph::Vec3 outward{wall.normal[0], wall.normal[1], wall.normal[2]};
    if (wall.value < -half) return true;
    if (normal && wall.value < 0.1 * half && normal->normalized().dot(outward) < -0.5) return true;
  }
  return false;
}

/// Whether the command places a wound where it would bleed inside tissue.
bool buriesWound(const sph::World& world, const sph::Command& command) {
  if (const auto* add = std::get_if<sph::AddWound>(&command)) {
    return isBuried(world.description(), add->wound.position, add->wound.normal);
  }
  const auto* update = std::get_if<sph::UpdateWound>(&command);
  return update != nullptr && update->position && isBuried(world.description(), *update->position, update->normal);
}

/// What is wrong with how a command is taken: a refused one leaves no trace, and a wound that bleeds inside tissue is refused.
std::string applyCommand(sph::World& world, const sph::Command& command) {
  const std::uint64_t before = world.stateHash();
  if (!world.apply(command).ok()) return world.stateHash() == before ? "" : "a refused command left a trace";
  return buriesWound(world, command) ? "a wound inside tissue was not refused" : "";
}

/// Where everything is and how it moves, as statistics tell.
bool sameMotion(const sph::WorldStats& a, const sph::WorldStats& b) {
  return a.step == b.step && a.time == b.time && a.particles == b.particles && a.injected == b.injected &&
         a.removed == b.removed && a.center == b.center && a.momentum == b.momentum && a.kinetic_energy == b.kinetic_energy;
}

class PlanRun {
 public:
  PlanRun(const TorturePlan& plan, scene::SceneDescription scene, std::unique_ptr<sph::World> world)
      : plan_{plan}, scene_{std::move(scene)}, world_{std::move(world)}, watch_{*world_, always_} {}

  /// What did not hold, with its step; empty if all did.
  std::string run() {
    double limit = std::numeric_limits<double>::infinity();
    for (int step = 0; step < plan_.steps; ++step) {
      for (const TimedCommand& timed : plan_.commands) {
        if (timed.step != step) continue;
        if (const std::string wrong = applyCommand(*world_, timed.command); !wrong.empty()) return at(step, wrong);
      }
      for (const TimedChange& timed : plan_.changes) {
        if (timed.step != step) continue;
        if (const std::string wrong = switchEffect(timed.change); !wrong.empty()) return at(step, wrong);
      }
      for (const TimedLimit& timed : plan_.limits) {
        if (timed.step != step) continue;
        if (timed.limit > 0.0)
          limit = timed.limit;
        else if (!refusesBadLimit(*world_, timed.limit))
          return at(step, "a limit of no time was not refused, or left a trace");
      }
      if (const Status status = world_->step(limit); !status.ok()) {
        return plan_.scene.model() == scene::Scene::LITERAL && world_->faulted() ? std::string{} : at(step, status.message());
      }
      watch_.check(*world_);
      particle_steps_ += world_->particleCount();
      if (!always_.holds()) return at(step, brokenBy(always_));
    }
    return {};
  }

  std::string atStart() const { return brokenBy(always_); }
  void report(TortureOutcome& outcome) const {
    outcome.particle_steps = particle_steps_;
    outcome.switched = switched_;
    outcome.not_switched = not_switched_;
    outcome.counters = stats().counters;
  }

 private:
  /// As a session does it: another world takes the state over. What is wrong with that; a refusal is not, but leaves no trace.
  std::string switchEffect(const scene::EffectChange& change) {
    Result<scene::SceneDescription> changed = scene::changeEffect(scene_, change, scene::Session{world_->speedOfSound()});
    if (!changed) return refuseChange();
    auto next = sph::createWorld(
        changed->world, {.threads = plan_.threads, .precision = plan_.precision, .speed_of_sound = world_->speedOfSound()});
    if (!next) return refuseChange();
    const sph::WorldStats before = stats();
    const std::uint64_t hash = world_->stateHash();
    if (!(*next)->adopt(*world_).ok()) { return world_->stateHash() == hash ? refuseChange() : "a refused switch left a trace"; }
    world_ = std::move(*next);
    scene_ = std::move(*changed);
    ++switched_;
    if (!sameMotion(before, stats())) return fmt::format("the switch of {} changed the motion", change.name);
    watch_.check(*world_);
    return always_.holds() ? std::string{} : brokenBy(always_);
  }

  std::string refuseChange() {
    ++not_switched_;
    return {};
  }

  sph::WorldStats stats() const {
    sph::WorldStats stats;
    world_->collectStats(stats);
    return stats;
  }

  static std::string at(int step, const std::string& what) { return fmt::format("step {}: {}", step, what); }

  const TorturePlan& plan_;
  scene::SceneDescription scene_;
  std::unique_ptr<sph::World> world_;
  Always always_;
  AlwaysWatch watch_;
  std::uint64_t particle_steps_ = 0;
  std::uint64_t switched_ = 0;
  std::uint64_t not_switched_ = 0;
};

}  // namespace

TortureOutcome runPlan(const TorturePlan& plan) {
  TortureOutcome outcome;
  const auto refuse = [&](const Status& status) {
    outcome.refused = true;
    outcome.text = status.message();
    return outcome;
  };
  auto scene = scene::parseScene(toText(plan));
  if (!scene) return refuse(scene.status());
  auto world = sph::createWorld(scene->world, {.threads = plan.threads, .precision = plan.precision});
  if (!world) return refuse(world.status());
  PlanRun run{plan, std::move(*scene), std::move(*world)};
  outcome.text = run.atStart();
  if (outcome.text.empty()) outcome.text = run.run();
  outcome.holds = outcome.text.empty();
  run.report(outcome);
  return outcome;
}

}  // namespace bleedsim::lab
