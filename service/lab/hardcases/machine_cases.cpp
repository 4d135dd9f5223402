// Hard cases 16 and 20: what the machine makes of it.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"
#include "service/sph/executor.h"

namespace bleedsim::lab {
namespace {

/// Blood whose velocities are denormal, or of the ordinary kind.
sph::WorldDescription drifting(double speed) {
  sph::WorldDescription scene = weightlessScene();
  addBox(scene, {10, 10, 10});
  addBlock(scene, sph::Vec3::Zero(), {10, 10, 10}, sph::Vec3::Constant(speed));
  return scene;
}

/// Workers of an executor on which a product of normal numbers is a denormal one.
double workersWithoutFlush(int threads) {
  std::vector<double> products(static_cast<std::size_t>(threads), 1.0);
  const auto executor = sph::makeExecutor(threads);
  executor->run(threads, [&](int share) {
    volatile double small = std::numeric_limits<double>::min();
    volatile double quarter = 0.25;
    products[static_cast<std::size_t>(share)] = small * quarter;
  });
  return static_cast<double>(std::count_if(products.begin(), products.end(), [](double product) { return product != 0.0; }));
}

using StageSeconds = std::array<double, static_cast<int>(sph::Stage::count)>;

/// Runs a number of steps; the wall time of each stage meanwhile, s.
std::optional<StageSeconds> timeStages(Trial& trial, int steps) {
  StageSeconds seconds = trial.stats().stage_seconds;
  if (!trial.runSteps(steps)) return std::nullopt;
  const StageSeconds after = trial.stats().stage_seconds;
  for (std::size_t k = 0; k < seconds.size(); ++k) seconds[k] = after[k] - seconds[k];
  return seconds;
}

/// A stage's time in the turn that others on the machine disturbed least.
double fastestOf(const std::vector<StageSeconds>& turns, std::size_t stage) {
  double fastest = turns.front()[stage];
  for (const StageSeconds& turn : turns) fastest = std::min(fastest, turn[stage]);
  return fastest;
}

/// Largest ratio of a stage's time, of the stages that take a hundredth of the step and more.
double slowestStage(const std::vector<StageSeconds>& denormal, const std::vector<StageSeconds>& ordinary) {
  double whole = 0.0;
  for (std::size_t k = 0; k < ordinary.front().size(); ++k) whole += fastestOf(ordinary, k);
  double slowest = 0.0;
  for (std::size_t k = 0; k < ordinary.front().size(); ++k) {
    const double usual = fastestOf(ordinary, k);
    if (usual > 0.01 * whole) slowest = std::max(slowest, fastestOf(denormal, k) / usual);
  }
  return slowest;
}

constexpr double kToggledViscosity = 0.02;  // Pa s

/// A pool over a bowl that takes forces, and a wound beside it: enough particles for a second thread.
sph::WorldDescription busyScene() {
  sph::WorldDescription scene = bloodScene();
  scene.domain.lower.z() = -0.02;
  scene.effects.gravity.emplace();
  scene.effects.applied_force.emplace();
  sph::BowlShape bowl;
  bowl.sphere_radius = 0.02;
  bowl.depth = 0.008;
  scene.tissue.push_back({.name = "bowl", .shape = bowl});
  addBlock(scene, {-0.008, -0.008, 0.0005}, {16, 16, 8}, {0.05, 0.02, 0.0});
  scene.fluid_blocks.front().jitter = 0.1;
  scene.wounds.push_back(discWound(0.003, 2e-6));
  scene.wounds.front().position = {0.03, 0, 0};
  return scene;
}

template <class Settings>
void toggle(std::optional<Settings>& effect) {
  if (effect) {
    effect.reset();
  } else {
    effect.emplace();
  }
}

constexpr std::array kChanges{20, 25, 35, 45};  // steps

/// What acts from that step on. Repulsion, and from the second change on platelets, tension and core radius, too, go where they
/// were and come where they were not; then they are again as at the start. The thicker blood stays.
sph::WorldDescription changedScene(const CaseRun& run, int step) {
  sph::WorldDescription scene = run.prepared(busyScene());
  scene.effects.viscosity->viscosity = kToggledViscosity;
  if (step >= kChanges[0] && step < kChanges[2]) toggle(scene.effects.repulsion);
  if (step >= kChanges[1] && step < kChanges[3]) {
    toggle(scene.effects.platelets);
    toggle(scene.effects.surface_tension);
    toggle(scene.effects.core_radius);
  }
  return scene;
}

/// Effects that act in one of the worlds only.
double differentEffects(const sph::EffectSettings& a, const sph::EffectSettings& b) {
  int count = 0;
  for (const bool differs :
       {a.repulsion.has_value() != b.repulsion.has_value(), a.platelets.has_value() != b.platelets.has_value(),
        a.surface_tension.has_value() != b.surface_tension.has_value(), a.core_radius.has_value() != b.core_radius.has_value()}) {
    count += differs ? 1 : 0;
  }
  return count;
}

/// What a session does at given steps: pushes, a wound that moves, viscosity that changes, effects that come and go.
bool act(CaseRun& run, Trial& trial, int step, int threads) {
  if (step == 10) return trial.apply(push({0, 0, 0.004}, 0.004, {0.01, 0, -0.005}));
  if (std::find(kChanges.begin(), kChanges.end(), step) != kChanges.end()) {
    return trial.change(run.build(changedScene(run, step), threads));
  }
  if (step == 30) {
    sph::UpdateWound move;
    move.wound_id = 1;
    move.position = sph::Vec3{0.03, 0.005, 0};
    return trial.apply(move);
  }
  return step != 40 || trial.apply(sph::RemoveForce{1});
}

}  // namespace

void denormals(CaseRun& run) {
  const auto tiny = run.start(drifting(run.byPrecision(1e-41, 1e-312)));
  const auto ordinary = run.start(drifting(1e-4));
  if (!tiny || !ordinary) return;
  constexpr int kTurns = 60;
  std::vector<StageSeconds> slow, usual;
  for (int turn = 0; turn < (run.setup().timed ? kTurns : 3); ++turn) {
    const auto with = timeStages(*tiny, 5);
    const auto without = timeStages(*ordinary, 5);
    if (!with || !without) return;
    slow.push_back(*with);
    usual.push_back(*without);
  }
  if (run.setup().timed) run.atMost("slowest stage, over the same without denormals", slowestStage(slow, usual), 2.0);
  run.within("workers without flush-to-zero, of 2", workersWithoutFlush(2), 0.0, 0.0);
}

void sameBits(CaseRun& run) {
  const auto one = run.start(busyScene(), 1);
  const auto two = run.start(busyScene(), 2);
  if (!one || !two) return;
  double differing = 0.0;
  double toggled = 0.0;
  for (int step = 0; step < 55; ++step) {
    const sph::EffectSettings before = one->world().description().effects;
    if (!act(run, *one, step, 1) || !act(run, *two, step, 2)) return;
    toggled += differentEffects(before, one->world().description().effects);
    if (step % 10 == 5) {  // a pause: no step, but readers and a refused command
      two->frame();
      two->stats();
      if (two->world().apply(sph::RemoveWound{99}).ok()) differing += 1.0;
    }
    if (!one->step() || !two->step()) return;
    if (one->world().stateHash() != two->world().stateHash()) differing += 1.0;
  }
  run.atLeast("particles", one->world().particleCount(), 2000.0);
  run.within("effects that came or went", toggled, 8.0, 8.0);
  run.within("steps with other bits", differing, 0.0, 0.0);
}

}  // namespace bleedsim::lab
