// Hard cases 1 to 4: particles that are where they cannot be, and blows.
#include <algorithm>
#include <cmath>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

/// |momentum less that of the start| over the most that sum m |v| was. What is watched feels no outer force: gravity is zero,
/// also among all effects.
class MomentumWatch {
 public:
  explicit MomentumWatch(Trial& trial)
      : trial_{trial}, start_{trial.stats().momentum}, flow_{momentumScale(trial.world(), trial.frame())} {}

  void look() { flow_ = std::max(flow_, momentumScale(trial_.world(), trial_.frame())); }
  double error() const { return (trial_.stats().momentum - start_).norm() / flow_; }

 private:
  Trial& trial_;
  sph::Vec3 start_;
  double flow_;
};

sph::WorldDescription pairOnASpot(bool in_blood) {
  sph::WorldDescription scene = weightlessScene();
  const sph::Vec3 spot = sph::Vec3::Constant(0.5 * kCaseSpacing);
  // Two in the air have less than rest density, so only repulsion parts them.
  if (!in_blood) scene.effects.repulsion.emplace();
  if (in_blood) addBlock(scene, sph::Vec3::Constant(-3.0 * kCaseSpacing), {6, 6, 6});
  for (int k = in_blood ? 1 : 0; k < 2; ++k) addLoneParticle(scene, spot);
  return scene;
}

sph::WorldDescription overlap(double distance) {
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity.emplace();
  addPlane(scene, {0, 0, -0.003}, sph::Vec3::UnitZ());
  addBlock(scene, {0, 0, 0}, {5, 5, 5});
  addBlock(scene, sph::Vec3::Constant(distance * kCaseSpacing / std::sqrt(3.0)), {5, 5, 5});
  return scene;
}

/// Of blood at the density of the frame, and what the fall from the blocks' top to the floor adds, J. p = c0^2 (rho - rho0) has
/// stored c0^2 (ln s + 1/s - 1) per mass at s = rho/rho0 > 1, and (16) gives back just that.
double energyOfOverlap(Trial& trial) {
  constexpr double kFall = 0.009;  // m
  const sph::World& world = trial.world();
  const double rest_density = world.description().rest_density;
  const double square = world.speedOfSound() * world.speedOfSound();
  const sph::FrameBuffer& frame = trial.frame();
  double sum = kCaseGravity * kFall * frame.count;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const double s = std::max(1.0, static_cast<double>(frame.density[i]) / rest_density);
    sum += square * (std::log(s) + 1.0 / s - 1.0);
  }
  return world.particleMass() * sum;
}

double cutsOf(const Trial& trial) {
  return static_cast<double>(trial.counted(sph::Counter::acceleration_clamped) +
                             trial.counted(sph::Counter::infinite_force_capped) + trial.counted(sph::Counter::speed_clamped));
}

constexpr int kBlockAcross = 6;

sph::WorldDescription shot(double speed) {
  sph::WorldDescription scene = weightlessScene();
  scene.domain.lower = sph::Vec3::Constant(-0.1);
  scene.domain.upper = sph::Vec3::Constant(0.1);
  const double half = 0.5 * kBlockAcross * kCaseSpacing;
  addBlock(scene, sph::Vec3::Constant(-half), {kBlockAcross, kBlockAcross, kBlockAcross});
  addBlock(scene, {-half - 3.0 * kCaseSpacing, -kCaseSpacing, -kCaseSpacing}, {2, 2, 2},
           {speed * sph::speedOfSound(scene), 0, 0});
  return scene;
}

/// Mean velocity of the block along the shot, over what it would be if the bullet had stayed in it.
double responseOf(Trial& trial, double speed) {
  constexpr std::uint32_t kBlock = kBlockAcross * kBlockAcross * kBlockAcross;
  const sph::FrameBuffer& frame = trial.frame();
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    if (frame.id[i] <= kBlock) sum += velocityOf(frame, i).x();
  }
  const double clamped = std::min(speed, 2.0) * trial.world().speedOfSound();
  return sum / kBlock / (8.0 * clamped / (kBlock + 8.0));
}

}  // namespace

// They start 0.002 dx apart once they are found. 15 dx/c0 later they are 25 times as far apart, at least.
void coincidentParticles(CaseRun& run) {
  for (const bool in_blood : {false, true}) {
    const std::string where = in_blood ? ", in blood" : ", in air";
    const auto trial = run.start(pairOnASpot(in_blood));
    const auto again = run.start(pairOnASpot(in_blood));
    if (!trial || !again) return;
    const double seconds = 15.0 * kCaseSpacing / trial->world().speedOfSound();
    MomentumWatch momentum{*trial};
    if (!trial->runFor(seconds, [&] { momentum.look(); }) || !again->runFor(seconds)) return;
    run.atLeast("distance, dx" + where, smallestDistance(*trial), 0.05);
    run.atMost("error of momentum" + where, momentum.error(), 1e-6);
    run.within("second run differs" + where, trial->world().stateHash() == again->world().stateHash() ? 0.0 : 1.0, 0.0, 0.0);
  }
}

// A density that lacked a neighbour would lack some 2e-4 of itself and more; float sums of 5000 terms err by less than a tenth of
// that.
void fiveThousandInACell(CaseRun& run) {
  constexpr int kMany = 5000;
  sph::WorldDescription scene = bloodScene();
  scene.capacity = kMany;
  Dice dice{2};
  const double cell = scene.supportRadius();
  for (int k = 0; k < kMany; ++k) {
    addLoneParticle(scene, dice.within(sph::Vec3::Constant(0.001 * cell), sph::Vec3::Constant(0.999 * cell)));
  }
  const auto trial = run.start(scene);
  if (!trial) return;
  const sph::SmoothingKernel kernel = trial->world().description().densityKernel();
  const sph::FrameBuffer& frame = trial->frame();
  double worst = 0.0;
  for (std::size_t i = 0; i < frame.count; i += 250) {
    double sum = 0.0;
    for (std::size_t j = 0; j < frame.count; ++j) sum += kernel.value((positionOf(frame, i) - positionOf(frame, j)).norm());
    const double density = trial->world().particleMass() * sum;
    worst = std::max(worst, std::abs(static_cast<double>(frame.density[i]) / density - 1.0));
  }
  run.atMost("error of density", worst, 5e-5);
  run.atLeast("particles on the slow path, counted", static_cast<double>(trial->counted(sph::Counter::neighbor_overflow)), kMany);
  if (!trial->runSteps(3)) return;
  run.told("mean compression after 3 steps", trial->stats().mean_density_error);
}

// The density doubles, so p = rho0 c0^2: the worst that seeding can do. It blows apart, bounded and counted. The motion gets
// half and more of the energy that the overlap has stored, and no more than all of it and 2 % of finite steps; contacts store
// ten times as much there, up to the bound on speeds, and viscosity of platelets and changing radii take from it, so that energy
// and speed are asked without them. A plane front runs into the air at c0 ln 2, because sound has one speed at every density, so
// a corner, which three fronts make, at sqrt(3) times that at most. In the last tenth nothing is cut. Printed, (17) is no
// gradient of an energy: there all this is told. Who is thrown out of the domain is counted, everyone else is there.
void overlappingSeeds(CaseRun& run) {
  for (const double distance : {0.0, 0.1, 0.2, 0.3}) {
    const std::string at = ", " + std::to_string(distance).substr(0, 3) + " dx";
    const auto trial = run.start(overlap(distance));
    if (!trial) return;
    const double stored = energyOfOverlap(*trial);
    double most = 0.0;
    double fastest = 0.0;
    const auto look = [&] {
      const sph::WorldStats stats = trial->stats();
      most = std::max(most, stats.kinetic_energy);
      fastest = std::max(fastest, stats.max_speed);
    };
    if (!trial->step(1e-9) || !trial->runFor(0.054, look)) return;
    const double cuts = cutsOf(*trial);
    if (!trial->runFor(0.006, look)) return;
    const sph::WorldStats stats = trial->stats();
    const double of_sound = fastest / trial->world().speedOfSound();
    const double late_cuts = cutsOf(*trial) - cuts;
    if (run.literal() || run.all()) {
      run.told("kinetic energy over the stored" + at, most / stored);
      run.told("fastest, of c0" + at, of_sound);
    } else {
      run.within("kinetic energy over the stored" + at, most / stored, 0.5, 1.02);
      run.atMost("fastest, of c0" + at, of_sound, std::sqrt(3.0) * std::log(2.0));
    }
    if (run.literal()) {
      run.told("clamps in the last tenth" + at, late_cuts);
    } else {
      run.within("clamps in the last tenth" + at, late_cuts, 0.0, 0.0);
    }
    const auto seeded = static_cast<double>(stats.injected);
    const auto known = static_cast<double>(stats.particles + trial->counted(sph::Counter::left_domain));
    run.within("neither there nor counted as gone" + at, seeded - known, 0.0, 0.0);
    run.atMost("mean compression" + at, stats.mean_density_error, 0.015);
  }
}

void bullet(CaseRun& run) {
  for (const double speed : {1.0, 5.0, 10.0}) {
    const std::string at = ", " + std::to_string(std::lround(speed)) + " c0";
    const auto trial = run.start(shot(speed));
    if (!trial) return;
    MomentumWatch momentum{*trial};
    if (!trial->runFor(12.0 * kCaseSpacing / trial->world().speedOfSound(), [&] { momentum.look(); })) return;
    const auto clamps = static_cast<double>(trial->counted(sph::Counter::speed_clamped));
    if (speed > 1.0) {
      run.atLeast("speeds clamped" + at, clamps, 1.0);
      run.told("block's share of the momentum" + at, responseOf(*trial, speed));
    } else {
      run.atMost("error of momentum" + at, momentum.error(), 1e-6);
      run.atLeast("block's share of the momentum" + at, responseOf(*trial, speed), 0.5);
    }
  }
}

}  // namespace bleedsim::lab
