// Hard cases 5, 6, 11 and 18: forces, steps and commands beyond reason.
#include <algorithm>
#include <cmath>
#include <limits>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint64_t clampsOf(const Trial& trial) {
  return trial.counted(sph::Counter::acceleration_clamped) + trial.counted(sph::Counter::infinite_force_capped) +
         trial.counted(sph::Counter::speed_clamped) + trial.counted(sph::Counter::tissue_projected);
}

}  // namespace

// A push of 1 mN, then a million times that for one frame, then nothing. In the last 0.05 s of the half second no clamp acts and
// nothing is faster than a fall through the pool.
void millionfoldForce(CaseRun& run) {
  constexpr double kSpacing = 0.003;  // m: half a second of the finer one takes too long
  sph::WorldDescription scene = bloodScene();
  scene.spacing = kSpacing;
  scene.effects = poolScene({6, 6, 6}, 3).effects;
  scene.effects.viscosity->viscosity = 0.02;
  addBox(scene, {6, 6, 6});
  addBlock(scene, sph::Vec3::Zero(), {6, 6, 3});
  scene.compressibility = {10.0, 0.3, 6 * kSpacing};
  const auto trial = run.start(scene);
  if (!trial) return;
  const sph::Vec3 middle{0.009, 0.009, 0.0045};
  constexpr double kFrame = 1.0 / 60.0;  // s
  if (!trial->apply(push(middle, 0.006, {1e-3, 0, 0})) || !trial->runFor(kFrame)) return;
  if (!trial->apply(push(middle, 0.006, {1e3, 0, 0})) || !trial->runFor(kFrame)) return;
  run.atLeast("clamps while it pushes", static_cast<double>(clampsOf(*trial)), 1.0);
  if (!trial->apply(sph::RemoveForce{1}) || !trial->runFor(0.45)) return;
  const std::uint64_t calm = clampsOf(*trial);
  if (!trial->runFor(0.05)) return;
  run.within("clamps in the last 0.05 s", static_cast<double>(clampsOf(*trial) - calm), 0.0, 0.0);
  run.atMost("v_rms/sqrt(g H)", speedRms(*trial) / std::sqrt(kCaseGravity * 3 * kSpacing), 1.0);
  run.atMost("mean compression", trial->stats().mean_density_error, 1.5 / (10.0 * 10.0));
  run.within("particles lost", static_cast<double>(trial->stats().removed), 0.0, 0.0);
}

// To and fro at 10 m/s, twice the speed of sound. 0.3 s later nothing is faster than what falls through the depth of the pool.
void sweptSphere(CaseRun& run) {
  constexpr double kLength = 0.01;  // m
  constexpr int kDeep = 4;
  const auto trial = run.start(poolScene({10, 6, 7}, kDeep));
  if (!trial) return;
  for (double time = 0.0; time < 0.03; time = trial->world().time()) {
    const double way = std::fmod(10.0 * time, 2.0 * kLength);
    const bool back = way > kLength;
    const sph::Vec3 at{back ? 2.0 * kLength - way : way, 0.003, 0.002};
    if (!trial->apply(push(at, 0.003, {back ? -0.05 : 0.05, 0, 0})) || !trial->step()) return;
  }
  const double fastest = trial->stats().max_speed;
  if (!trial->apply(sph::RemoveForce{1}) || !trial->runFor(0.06)) return;
  run.told("fastest while it sweeps, m/s", fastest);
  run.atMost("fastest 0.06 s later, m/s", trial->stats().max_speed, fastest);
  if (!trial->runFor(0.24)) return;
  run.atMost("fastest 0.3 s later, m/s", trial->stats().max_speed, std::sqrt(2.0 * kCaseGravity * kDeep * kCaseSpacing));
  run.within("particles lost", static_cast<double>(trial->stats().removed), 0.0, 0.0);
}

void timeStepRequests(CaseRun& run) {
  const auto trial = run.start(poolScene({6, 6, 6}, 4));
  if (!trial || !trial->step(1.0)) return;
  sph::World& world = trial->world();
  const double stable = trial->stats().dt;
  run.atMost("step of 1 s, over 0.4 dx/c0", stable / (0.4 * kCaseSpacing / world.speedOfSound()), 1.0);
  const std::uint64_t before = world.stateHash();
  int accepted = 0;
  for (const double limit : {0.0, -1.0, kNan, -kInfinity}) accepted += world.step(limit).ok() ? 1 : 0;
  run.within("bad requests accepted", accepted, 0.0, 0.0);
  run.within("state changed by them", world.stateHash() == before ? 0.0 : 1.0, 0.0, 0.0);
  if (!trial->step(1e-3 * stable)) return;
  run.within("short request, over itself", trial->stats().dt / (1e-3 * stable), 1.0, 1.0);
  if (!trial->step()) return;
  run.atLeast("step after it, over the one before", trial->stats().dt / stable, 0.5);
}

void badCommands(CaseRun& run) {
  sph::WorldDescription scene = poolScene({6, 6, 6}, 3);
  const auto trial = run.start(scene);
  if (!trial || !trial->runSteps(5)) return;
  sph::World& world = trial->world();
  const std::uint64_t before = world.stateHash();
  std::vector<sph::Command> commands{sph::RemoveForce{5}, sph::RemoveWound{1}};
  // In the middle of the floor, where nothing but the bad number is wrong.
  const auto on_the_floor = [](double radius, double flow) {
    sph::WoundDescription wound = discWound(radius, flow);
    wound.position = {0.003, 0.003, 0};
    return wound;
  };
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      const sph::Vec3 off = bad * sph::Vec3::Unit(axis);
      commands.emplace_back(push({0, 0, 0}, 0.003, off));
      commands.emplace_back(push(off, 0.003, {0, 0, 0}));
      sph::WoundDescription wound = on_the_floor(0.001, 1e-7);
      wound.position = off;
      commands.emplace_back(sph::AddWound{wound});
      wound = on_the_floor(0.001, 1e-7);
      wound.normal = off;
      commands.emplace_back(sph::AddWound{wound});
    }
    commands.emplace_back(push({0, 0, 0}, bad, {1e-3, 0, 0}));
    commands.emplace_back(sph::AddWound{on_the_floor(bad, 1e-7)});
    commands.emplace_back(sph::AddWound{on_the_floor(0.001, bad)});
    sph::WoundDescription wound = on_the_floor(0.001, 0.0);
    wound.drive = sph::PressureDriveSettings{.inlet_pressure = bad};
    commands.emplace_back(sph::AddWound{wound});
  }
  sph::SetForce until = push({0, 0, 0}, 0.003, {1e-3, 0, 0});
  until.until = kNan;
  commands.emplace_back(until);
  int accepted = 0;
  for (const sph::Command& command : commands) accepted += world.apply(command).ok() ? 1 : 0;
  run.told("commands", static_cast<double>(commands.size()));
  run.within("accepted", accepted, 0.0, 0.0);
  run.within("state changed", world.stateHash() == before ? 0.0 : 1.0, 0.0, 0.0);
  const auto undisturbed = run.start(scene);
  if (!undisturbed || !undisturbed->runSteps(15) || !trial->runSteps(10)) return;
  run.within("later states differ", world.stateHash() == undisturbed->world().stateHash() ? 0.0 : 1.0, 0.0, 0.0);
}

}  // namespace bleedsim::lab
