// Hard cases 13 and 15: narrow tissue, and the end of the domain.
#include <cmath>
#include <numbers>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

constexpr int kAlong = 8;
constexpr double kSlice = kAlong * kCaseSpacing;  // m, along y, between periodic sides

sph::WorldDescription slice() {
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity.emplace();
  scene.domain.lower = {-0.03, 0, -0.012};
  scene.domain.upper = {0.03, kSlice, 0.08};
  scene.domain.periodic = {false, true, false};
  scene.compressibility.max_fall_or_depth = 0.015;
  return scene;
}

/// Two planes that meet at 30 degrees in the y axis, and blood that falls between them.
sph::WorldDescription cusp() {
  const double half = std::numbers::pi / 12.0;
  sph::WorldDescription scene = slice();
  addPlane(scene, sph::Vec3::Zero(), {std::cos(half), 0, std::sin(half)});
  addPlane(scene, sph::Vec3::Zero(), {-std::cos(half), 0, std::sin(half)});
  addBlock(scene, {-0.002, 0, 0.0095}, {4, kAlong, 5});
  return scene;
}

/// Two blocks of tissue that stand `gap` spacings apart, under a pool.
sph::WorldDescription overAGap(double gap) {
  sph::WorldDescription scene = slice();
  for (const double side : {-1.0, 1.0}) {
    sph::BoxShape box;
    box.obstacle = true;
    const double edge = side * 0.5 * gap * kCaseSpacing;
    box.lower = {std::min(edge, side * 0.015), -0.01, -0.011};
    box.upper = {std::max(edge, side * 0.015), kSlice + 0.01, 0.0};
    scene.tissue.push_back({.name = side < 0.0 ? "left" : "right", .shape = box});
    addPlane(scene, {side * 0.003, 0, 0}, {-side, 0, 0});
  }
  addBlock(scene, {-0.003, 0, 0}, {6, kAlong, 3});
  return scene;
}

}  // namespace

// A particle has room between walls that stand a spacing apart, so gaps of 1 and 2 dx may be run through; nothing may be in the
// tissue beside them, and nothing comes through half a spacing.
void cuspAndGaps(CaseRun& run) {
  const auto wedge = run.start(cusp());
  if (!wedge || !wedge->runFor(0.1)) return;
  run.within("particles lost in the cusp", static_cast<double>(wedge->stats().removed), 0.0, 0.0);
  run.told("v_rms in the cusp, m/s", speedRms(*wedge));
  for (const double gap : {0.5, 1.0, 2.0}) {
    const auto trial = run.start(overAGap(gap));
    if (!trial || !trial->runFor(0.05)) return;
    const sph::FrameBuffer& frame = trial->frame();
    auto through = static_cast<double>(trial->stats().removed);
    for (std::size_t i = 0; i < frame.count; ++i) through += positionOf(frame, i).z() < -0.5 * kCaseSpacing ? 1.0 : 0.0;
    const std::string name = "particles through " + std::to_string(gap).substr(0, 3) + " dx";
    gap < 1.0 ? run.within(name, through, 0.0, 0.0) : run.told(name, through);
  }
}

void leavingTheDomain(CaseRun& run) {
  sph::WorldDescription scene = bloodScene();
  addBlock(scene, {0.04, 0, 0}, {4, 4, 4}, {0.5, 0, 0});
  addBlock(scene, {-0.02, 0, 0}, {4, 4, 4});
  const auto trial = run.start(scene);
  if (!trial || !trial->runFor(0.05)) return;
  const sph::WorldStats stats = trial->stats();
  run.within("injected", static_cast<double>(stats.injected), 128.0, 128.0);
  run.within("removed", static_cast<double>(stats.removed), 64.0, 64.0);
  run.within("left_domain", static_cast<double>(trial->counted(sph::Counter::left_domain)), 64.0, 64.0);
}

}  // namespace bleedsim::lab
