#include "service/lab/torture/torture.h"

#include <fmt/format.h>
#include <optional>

#include "service/lab/hardcases/always.h"
#include "service/lab/hardcases/report.h"
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

class PlanRun {
 public:
  PlanRun(const TorturePlan& plan, sph::World& world) : plan_{plan}, world_{world}, watch_{world, always_} {}

  /// What did not hold, with its step; empty if all did.
  std::string run() {
    double limit = std::numeric_limits<double>::infinity();
    for (int step = 0; step < plan_.steps; ++step) {
      for (const TimedCommand& timed : plan_.commands) {
        if (timed.step != step) continue;
        if (const std::string wrong = applyCommand(world_, timed.command); !wrong.empty()) return at(step, wrong);
      }
      for (const TimedLimit& timed : plan_.limits) {
        if (timed.step != step) continue;
        if (timed.limit > 0.0)
          limit = timed.limit;
        else if (!refusesBadLimit(world_, timed.limit))
          return at(step, "a limit of no time was not refused, or left a trace");
      }
      if (const Status status = world_.step(limit); !status.ok()) {
        return plan_.scene.model() == scene::Scene::LITERAL && world_.faulted() ? std::string{} : at(step, status.message());
      }
      watch_.check(world_);
      particle_steps_ += world_.particleCount();
      if (!always_.holds()) return at(step, brokenBy(always_));
    }
    return {};
  }

  std::uint64_t particleSteps() const { return particle_steps_; }
  std::string atStart() const { return brokenBy(always_); }

 private:
  static std::string at(int step, const std::string& what) { return fmt::format("step {}: {}", step, what); }

  const TorturePlan& plan_;
  sph::World& world_;
  Always always_;
  AlwaysWatch watch_;
  std::uint64_t particle_steps_ = 0;
};

}  // namespace

TortureOutcome runPlan(const TorturePlan& plan) {
  TortureOutcome outcome;
  const auto refuse = [&](const Status& status) {
    outcome.refused = true;
    outcome.text = status.message();
    return outcome;
  };
  const auto scene = scene::parseScene(toText(plan));
  if (!scene) return refuse(scene.status());
  auto world = sph::createWorld(scene->world, {.threads = plan.threads, .precision = plan.precision});
  if (!world) return refuse(world.status());
  PlanRun run{plan, **world};
  outcome.text = run.atStart();
  if (outcome.text.empty()) outcome.text = run.run();
  outcome.holds = outcome.text.empty();
  outcome.particle_steps = run.particleSteps();
  sph::WorldStats stats;
  (*world)->collectStats(stats);
  outcome.retried = stats.counters[static_cast<std::size_t>(sph::Counter::step_retried)];
  return outcome;
}

}  // namespace bleedsim::lab
