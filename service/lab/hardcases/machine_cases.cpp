// Hard cases 16 and 20: what the machine makes of it.
#include <algorithm>
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

/// What a session does at given steps: pushes, a wound that moves, viscosity that changes, repulsion that comes and goes unless
/// every effect is on.
bool act(CaseRun& run, Trial& trial, int step, int threads) {
  if (step == 10) return trial.apply(push({0, 0, 0.004}, 0.004, {0.01, 0, -0.005}));
  if (step == 20 || step == 35) {
    sph::WorldDescription thicker = busyScene();
    thicker.effects.viscosity->viscosity = kToggledViscosity;
    if (step == 20) thicker.effects.repulsion.emplace();
    return trial.change(run.build(thicker, threads));
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
  for (int step = 0; step < 50; ++step) {
    if (!act(run, *one, step, 1) || !act(run, *two, step, 2)) return;
    if (step % 10 == 5) {  // a pause: no step, but readers and a refused command
      two->frame();
      two->stats();
      if (two->world().apply(sph::RemoveWound{99}).ok()) differing += 1.0;
    }
    if (!one->step() || !two->step()) return;
    if (one->world().stateHash() != two->world().stateHash()) differing += 1.0;
  }
  run.atLeast("particles", one->world().particleCount(), 2000.0);
  run.within("steps with other bits", differing, 0.0, 0.0);
}

}  // namespace bleedsim::lab
