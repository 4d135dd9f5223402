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

// The density doubles, so p = rho0 c0^2: the worst that seeding can do. It blows apart, bounded and counted.
void overlappingSeeds(CaseRun& run) {
  for (const double distance : {0.0, 0.1, 0.2, 0.3}) {
    const auto trial = run.start(overlap(distance));
    if (!trial || !trial->step(1e-9) || !trial->runFor(0.06)) return;
    run.atMost("mean compression, " + std::to_string(distance).substr(0, 3) + " dx", trial->stats().mean_density_error, 0.015);
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
