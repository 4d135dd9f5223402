// Hard cases 13 and 15: narrow tissue, and the end of the domain.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

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

constexpr int kPoolAcross = 6;
constexpr int kPoolDeep = 3;
constexpr double kPoolHalf = 0.5 * kPoolAcross * kCaseSpacing;  // m
constexpr double kBlockDepth = 0.011;                           // m

/// Two blocks of tissue that stand `gap` spacings apart, under a pool.
sph::WorldDescription overAGap(double gap) {
  sph::WorldDescription scene = slice();
  for (const double side : {-1.0, 1.0}) {
    sph::BoxShape box;
    box.obstacle = true;
    const double edge = side * 0.5 * gap * kCaseSpacing;
    box.lower = {std::min(edge, side * 0.015), -0.01, -kBlockDepth};
    box.upper = {std::max(edge, side * 0.015), kSlice + 0.01, 0.0};
    scene.tissue.push_back({.name = side < 0.0 ? "left" : "right", .shape = box});
    addPlane(scene, {side * kPoolHalf, 0, 0}, {-side, 0, 0});
  }
  addBlock(scene, {-kPoolHalf, 0, 0}, {kPoolAcross, kAlong, kPoolDeep});
  return scene;
}

/// Who is below the upper faces of the blocks, and whether everyone came there through the gap.
class GapWatch {
 public:
  GapWatch(Trial& trial, double gap)
      : trial_{trial}, half_{(0.5 * gap + kEdge) * kCaseSpacing}, entered_(trial.stats().injected + 1) {}

  void look() {
    const sph::FrameBuffer& frame = trial_.frame();
    for (std::size_t i = 0; i < frame.count; ++i) {
      const sph::Vec3 at = positionOf(frame, i);
      if (at.z() > -0.5 * kCaseSpacing || at.z() < -kBlockDepth) continue;
      if (std::abs(at.x()) <= half_) {
        entered_[frame.id[i]] = true;
      } else {
        ++beside_;
      }
    }
  }
  double entered() const { return static_cast<double>(std::count(entered_.begin(), entered_.end(), true)); }
  /// Particle-steps in the tissue's depth and not in the gap, and particles that are gone without having been in it.
  double leaked() {
    std::vector<bool> there(entered_.size(), false);
    const sph::FrameBuffer& frame = trial_.frame();
    for (std::size_t i = 0; i < frame.count; ++i) there[frame.id[i]] = true;
    std::size_t lost = 0;
    for (std::size_t id = 1; id < there.size(); ++id) lost += there[id] || entered_[id] ? 0 : 1;
    return static_cast<double>(beside_ + lost);
  }

 private:
  static constexpr double kEdge = 0.1;  // spacings, what "always" allows

  Trial& trial_;
  double half_;                // m
  std::vector<bool> entered_;  // by id
  std::size_t beside_ = 0;
};

/// Particles that leave the pool through an opening of `gap` spacings by Torricelli's law, with a level that falls, and neither
/// friction nor a jet that narrows: v = sqrt(2 g h), so sqrt(h) = sqrt(H) - gap/width sqrt(g/2) t. The solver's pressures are
/// never below the air's, so that nothing sucks.
double fastestOutflow(double gap, double seconds) {
  const double full = std::sqrt(kPoolDeep * kCaseSpacing);
  const double left = std::max(0.0, full - gap / kPoolAcross * std::sqrt(0.5 * kCaseGravity) * seconds);
  return kPoolAcross * kAlong * kPoolDeep * (1.0 - left * left / (full * full));
}

}  // namespace

// No leak: blood is only where there is room for it. A particle is a spacing wide and keeps half of it from tissue, so that gaps
// of 0.5 and 1 dx are shut to it. One of 2 dx is open: blood must run into it, but no more than an ideal opening of that width
// lets through. Nothing may be in the tissue beside a gap, and nothing gets past it but through it.
void cuspAndGaps(CaseRun& run) {
  const auto wedge = run.start(cusp());
  if (!wedge || !wedge->runFor(0.1)) return;
  run.within("particles lost in the cusp", static_cast<double>(wedge->stats().removed), 0.0, 0.0);
  run.told("v_rms in the cusp, m/s", speedRms(*wedge));
  constexpr double kSeconds = 0.05;
  for (const double gap : {0.5, 1.0, 2.0}) {
    const auto trial = run.start(overAGap(gap));
    if (!trial) return;
    GapWatch watch{*trial, gap};
    if (!trial->runFor(kSeconds, [&] { watch.look(); })) return;
    const std::string width = std::to_string(gap).substr(0, 3) + " dx";
    const bool open = gap > 1.0;
    run.within("particles into " + width, watch.entered(), open ? kAlong : 0.0, open ? fastestOutflow(gap, kSeconds) : 0.0);
    run.within("particles past " + width + ", not through it", watch.leaked(), 0.0, 0.0);
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
