// Hard cases 7 and 8: viscosities that jump, in time and from one particle to the next.
#include <algorithm>
#include <cmath>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

constexpr int kAcross = 8;

/// A block in free flight that swirls; viscosity acts alone, so nothing but it changes the kinetic energy.
sph::WorldDescription swirl(double viscosity) {
  sph::WorldDescription scene = weightlessScene();
  scene.effects.pressure.reset();
  scene.effects.viscosity->viscosity = viscosity;
  Dice dice{7};
  for (int k = 0; k < kAcross * kAcross * kAcross; ++k) {
    const int x = k % kAcross;
    const int y = k / kAcross % kAcross;
    const int z = k / kAcross / kAcross;
    const sph::Vec3 at = kCaseSpacing * sph::Vec3{x + 0.5, y + 0.5, z + 0.5} +
                         dice.within(sph::Vec3::Constant(-0.2 * kCaseSpacing), sph::Vec3::Constant(0.2 * kCaseSpacing));
    addLoneParticle(scene, at, 0.2 * sph::Vec3{std::sin(900.0 * at.y()), std::sin(700.0 * at.z()), std::sin(1100.0 * at.x())});
  }
  return scene;
}

}  // namespace

// The change comes as a switched effect comes: another world adopts the state. With every effect on, what pressure, repulsion and
// tension hold turns into motion, however thick the blood is; then no rise may exceed what there was before the change.
void viscosityStep(CaseRun& run) {
  constexpr double kThin = 0.00345;  // Pa s
  const auto trial = run.start(swirl(kThin));
  if (!trial || !trial->runSteps(20) || !trial->change(run.build(run.prepared(swirl(1e4 * kThin))))) return;
  const double before = trial->stats().kinetic_energy;
  double last = before;
  double rise = -1.0;
  double most = 0.0;
  const auto look = [&] {
    const double now = trial->stats().kinetic_energy;
    rise = std::max(rise, now / last - 1.0);
    most = std::max(most, now / before);
    last = now;
  };
  if (!trial->runSteps(60, look)) return;
  run.atMostIfNeeded("largest rise of kinetic energy in a step, of itself", rise, 1e-6);
  run.atMost("largest kinetic energy, of that before", most, 1.0);
  run.atMost("kinetic energy after 60 steps, of that before", last / before, 0.5);
}

// The implicit solve ends with a residual of 1e-2; that it carries no momentum is what the bound asks of it.
void checkerboard(CaseRun& run) {
  constexpr int kSide = 6;
  sph::WorldDescription scene = weightlessScene();
  Dice dice{8};
  for (int k = 0; k < kSide * kSide * kSide; ++k) {
    const int x = k % kSide;
    const int y = k / kSide % kSide;
    const int z = k / kSide / kSide;
    addLoneParticle(scene, kCaseSpacing * sph::Vec3{x + 0.5, y + 0.5, z + 0.5},
                    dice.within(sph::Vec3::Constant(-0.1), sph::Vec3::Constant(0.1)));
    scene.fluid_blocks.back().viscosity = (x + y + z) % 2 == 0 ? 0.004 : 10.0;
  }
  const auto trial = run.start(scene);
  if (!trial) return;
  const sph::Vec3 start = trial->stats().momentum;
  const double scale = momentumScale(trial->world(), trial->frame());
  const double energy = trial->stats().kinetic_energy;
  if (!trial->runFor(0.005)) return;
  const sph::WorldStats stats = trial->stats();
  run.atMost("error of momentum", (stats.momentum - start).norm() / scale, 1e-6);
  run.told("kinetic energy left", stats.kinetic_energy / energy);
  run.told("iterations of the last solve", stats.viscosity_iterations);
}

}  // namespace bleedsim::lab
