// Hard cases 7 and 8: viscosities that jump, in time and from one particle to the next.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

constexpr int kAcross = 8;

/// Blood that fills a closed box and swirls in the x-z plane, without flow through the walls.
sph::WorldDescription swirl(double viscosity) {
  sph::WorldDescription scene = bloodScene();
  scene.effects.viscosity->viscosity = viscosity;
  addBox(scene, {kAcross, kAcross, kAcross});
  const double side = kAcross * kCaseSpacing;
  for (int i = 0; i < kAcross; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const double x = std::numbers::pi * (i + 0.5) / kAcross;
      const double z = std::numbers::pi * (k + 0.5) / kAcross;
      addBlock(scene, side / kAcross * sph::Vec3{double(i), 0, double(k)}, {1, kAcross, 1},
               0.3 * sph::Vec3{std::sin(x) * std::cos(z), 0, -std::cos(x) * std::sin(z)});
    }
  }
  return scene;
}

}  // namespace

// The change comes as a switched effect comes: another world adopts the state. Pressure may give back what compression holds,
// which is less than a millionth once viscosity rules.
void viscosityStep(CaseRun& run) {
  constexpr double kThin = 0.001;  // Pa s
  const auto trial = run.start(swirl(kThin));
  if (!trial || !trial->runSteps(50) || !trial->change(run.build(swirl(1e4 * kThin)))) return;
  const double before = trial->stats().kinetic_energy;
  double last = before;
  double rise = 0.0;
  const auto look = [&] {
    const double now = trial->stats().kinetic_energy;
    rise = std::max(rise, now - last);
    last = now;
  };
  if (!trial->runSteps(60, look)) return;
  run.atMost("largest rise in a step", rise / before, 1e-6);
  run.atMost("kinetic energy after 60 steps", last / before, 1.0);
}

void checkerboard(CaseRun& run) {
  constexpr int kSide = 6;
  sph::WorldDescription scene = bloodScene();
  Dice dice{8};
  for (int k = 0; k < kSide * kSide * kSide; ++k) {
    const int x = k % kSide;
    const int y = k / kSide % kSide;
    const int z = k / kSide / kSide;
    addParticle(scene, kCaseSpacing * sph::Vec3{x + 0.5, y + 0.5, z + 0.5},
                dice.within(sph::Vec3::Constant(-0.1), sph::Vec3::Constant(0.1)));
    scene.fluid_blocks.back().viscosity = (x + y + z) % 2 == 0 ? 0.004 : 10.0;
  }
  const auto trial = run.start(scene);
  if (!trial) return;
  const sph::Vec3 start = trial->stats().momentum;
  const double scale = momentumScale(*trial);
  const double energy = trial->stats().kinetic_energy;
  if (!trial->runFor(0.005)) return;
  const sph::WorldStats stats = trial->stats();
  const auto& gravity = trial->world().description().effects.gravity;
  const sph::Vec3 given =
      gravity ? sph::Vec3{trial->world().particleMass() * stats.particles * stats.time * gravity->acceleration} : sph::Vec3::Zero();
  run.atMost("error of momentum", (stats.momentum - start - given).norm() / scale, 1e-6);
  run.told("kinetic energy left", stats.kinetic_energy / energy);
  run.told("iterations of the last solve", stats.viscosity_iterations);
}

}  // namespace bleedsim::lab
