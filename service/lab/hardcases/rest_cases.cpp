// Hard cases 9, 10, 12 and 17: blood that should do nothing, or only fall.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

sph::WorldDescription landing() {
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity.emplace();
  scene.effects.viscosity->viscosity = 0.05;
  addPlane(scene, sph::Vec3::Zero(), sph::Vec3::UnitZ());
  scene.domain.lower.z() = -0.005;
  return scene;
}

sph::WorldDescription film() {
  constexpr int kAcross = 8;
  sph::WorldDescription scene = landing();
  scene.domain.lower = {0, 0, -0.005};
  scene.domain.upper = {kAcross * kCaseSpacing, kAcross * kCaseSpacing, 0.02};
  scene.domain.periodic = {true, true, false};
  addBlock(scene, {0, 0, 0.5 * kCaseSpacing}, {kAcross, kAcross, 1});
  return scene;
}

/// Of blood in a box of `across` by `across` spacings at the origin, m: the mean of what stands highest over each square spacing,
/// with the half spacing that is above its centre. Where nothing stands it is 0.
double surfaceHeight(Trial& trial, int across) {
  const double dx = trial.world().description().spacing;
  std::vector<double> heights(static_cast<std::size_t>(across * across), 0.0);
  const sph::FrameBuffer& frame = trial.frame();
  for (std::size_t i = 0; i < frame.count; ++i) {
    const sph::Vec3 at = positionOf(frame, i);
    const int column = std::clamp(static_cast<int>(at.x() / dx), 0, across - 1);
    const int row = std::clamp(static_cast<int>(at.y() / dx), 0, across - 1);
    double& height = heights[static_cast<std::size_t>(row * across + column)];
    height = std::max(height, at.z() + 0.5 * dx);
  }
  return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

}  // namespace

// One layer settles where the contact spring meets its weight, 0.50 dx less 0.0004 dx (walls.md); a thread that lands stays one,
// because nothing pulls across it unless tension acts, which makes drops of it.
void filmAndFilament(CaseRun& run) {
  const auto layer = run.start(film());
  if (!layer || !layer->runFor(0.2)) return;
  run.within("film's height, dx", layer->stats().center.z() / kCaseSpacing, 0.48, 0.52);
  run.atMost("film's v_rms/sqrt(g dx)", speedRms(*layer) / std::sqrt(kCaseGravity * kCaseSpacing), 0.01);
  sph::WorldDescription scene = landing();
  addBlock(scene, {-0.005, 0, 0.002}, {10, 1, 1});
  const auto thread = run.start(scene);
  if (!thread || !thread->runFor(0.4)) return;
  const sph::FrameBuffer& frame = thread->frame();
  double aside = 0.0;
  double off_height = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const sph::Vec3 at = positionOf(frame, i) / kCaseSpacing;
    aside = std::max(aside, std::abs(at.y() - 0.5));
    off_height = std::max(off_height, std::abs(at.z() - 0.5));
  }
  run.atMostIfNeeded("thread's spread, dx", aside, 0.01);
  run.atMostIfNeeded("thread's height off 0.5 dx", off_height, 0.02);
  run.within("particles lost", static_cast<double>(layer->stats().removed + thread->stats().removed), 0.0, 0.0);
}

// x = x0 + v t - g t^2/2, exact for kick-drift-kick. Relative to the fall 2e-4 in float and 1e-9 in double: physics.md section 5,
// case 2. A pair's distance is that of a frame, float32.
void ballistics(CaseRun& run) {
  for (const int count : {1, 2}) {
    const std::string of = count == 1 ? ", lone particle" : ", pair";
    const sph::Vec3 velocity{0.1, -0.05, 0.3};
    sph::WorldDescription scene = bloodScene();
    scene.domain.lower.z() = -0.4;
    scene.effects.gravity.emplace();
    addBlock(scene, sph::Vec3::Zero(), {count, 1, 1}, velocity);
    const auto trial = run.start(scene);
    if (!trial) return;
    const sph::Vec3 start = trial->stats().center;
    if (!trial->runFor(0.2)) return;
    const double time = trial->world().time();
    const sph::Vec3 drop{0, 0, -0.5 * kCaseGravity * time * time};
    const sph::Vec3 off = trial->stats().center - start - time * velocity - drop;
    run.atMost("error over the fall" + of, off.norm() / drop.norm(), run.byPrecision(2e-4, 1e-9));
    if (count == 2) run.atMostIfNeeded("change of distance, dx", std::abs(smallestDistance(*trial) - 1.0), 1e-3);
  }
}

// The column is shortest 2 H/c0 after the start, the largest of its rings. What splashes off its top counts as its top.
void deepColumn(CaseRun& run) {
  constexpr int kAcross = 4;
  constexpr int kDeep = 100;
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity.emplace();
  addBox(scene, {kAcross, kAcross, kDeep}, true);
  addBlock(scene, sph::Vec3::Zero(), {kAcross, kAcross, kDeep});
  scene.compressibility.max_fall_or_depth = kDeep * kCaseSpacing;
  const auto trial = run.start(scene);
  if (!trial) return;
  double off = 0.0;
  const auto look = [&] { off = std::max(off, std::abs(surfaceHeight(*trial, kAcross) / (kDeep * kCaseSpacing) - 1.0)); };
  look();
  const double ring = 2.5 * kDeep * kCaseSpacing / trial->world().speedOfSound();
  if (!trial->runFor(ring, look)) return;
  run.atMost("largest change of its top", off, 0.05);
  run.atMost("largest compression", trial->stats().max_density_error, 0.05);
}

// At 3 mm and c0 = 0.2 m/s, so that a minute is not out of reach; tension and adhesion are weaker in proportion to c0^2. Adhesion
// is an outer force as gravity is: it draws the blood to the walls, and what is left between them below rest density drifts by
// 0.073 dx, because nothing there pushes back. So the blood stands under a pressure, as in a vessel: 0.5 Pa, 1 % of rho c0^2 and
// ten times what adhesion builds up at a wall.
void weightlessRest(CaseRun& run) {
  constexpr int kAcross = 4;
  sph::WorldDescription scene = weightlessScene();
  scene.spacing = 0.003;
  scene.compressibility.design_speed = 0.02;
  addBox(scene, {kAcross, kAcross, kAcross});
  addBlock(scene, sph::Vec3::Zero(), {kAcross, kAcross, kAcross});
  if (run.all()) {
    const double slow = sph::speedOfSound(scene) / sph::speedOfSound(emptyScene());
    scene.effects.surface_tension.emplace().coefficient *= slow * slow;
    scene.effects.adhesion.emplace().acceleration *= slow * slow;
    scene.effects.pressure->background_pressure = 0.5;
  }
  const auto trial = run.start(scene);
  if (!trial) return;
  const std::vector<sph::Vec3> before = positionsById(*trial);
  if (!trial->runFor(60.0)) return;
  const std::vector<sph::Vec3> after = positionsById(*trial);
  double furthest = before.size() == after.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    furthest = std::max(furthest, (after[i] - before[i]).norm());
  }
  run.atMost("drift, dx", furthest / scene.spacing, 0.01);
}

}  // namespace bleedsim::lab
