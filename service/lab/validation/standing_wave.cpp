// Case 14: a standing wave, 10 cm long in 5 cm of water: omega^2 = g k tanh(k d), T = 0.2536 s. Free slip on the floor.
#include <cmath>
#include <numbers>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {

// The flat surface gets the velocity of the mode, amplitude 2.5 mm (k a = 0.16, whose own shift of the period is below 0.5 %).
// The velocities' part along the mode goes as cos(omega t): from its first zero to the third is one period.
Result<CaseResult> runStandingWave(const Knobs& knobs) {
  constexpr double kLength = 0.10;    // m
  constexpr double kDepth = 0.05;     // m
  constexpr double kHeight = 0.0025;  // m
  const double k = 2.0 * std::numbers::pi / kLength;
  const double omega = std::sqrt(kGravity * k * std::tanh(k * kDepth));
  const double expected = 2.0 * std::numbers::pi / omega;
  const double dx = kDepth / knobs.across;
  const int side = periodicCount(knobs);
  sph::WorldDescription scene = emptyScene(knobs, dx, 0.3);
  scene.rest_density = 1000.0;
  scene.compressibility.max_fall_or_depth = kDepth;
  scene.domain.lower = {0, 0, -8.0 * dx};
  scene.domain.upper = {kLength, side * dx, kDepth + 0.02};
  scene.domain.periodic = {true, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().viscosity = 0.001;
  scene.effects.gravity.emplace();
  scene.tissue.push_back({.name = "floor", .shape = sph::PlaneShape{}, .slip = 1.0});
  addBlock(scene, sph::Vec3::Zero(), {2 * knobs.across, side, knobs.across});
  const auto mode = [&](const sph::Vec3& at) -> sph::Vec3 {
    const double unit = omega * kHeight / std::sinh(k * kDepth);
    return {-unit * std::cosh(k * at.z()) * std::sin(k * at.x()), 0.0, unit * std::sinh(k * at.z()) * std::cos(k * at.x())};
  };
  setFlow(scene, 1, mode);
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  std::vector<double> zeros;
  picture::Series found{"solver", picture::SeriesStyle::line, {}, {}};
  picture::Series exact{"cos(omega t)", picture::SeriesStyle::line, {}, {}};
  double scale = 0.0;
  const Status status = world->runFor(1.35 * expected, [&] {
    if ((*world)->stepCount() % 10 != 0) return;
    const Frame frame = world->frame();
    double along = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) along += frame.velocity(i).dot(mode(frame.position(i)));
    if (scale == 0.0) scale = along;
    const double time = (*world)->time();
    along /= scale;
    if (!found.y.empty() && found.y.back() * along < 0.0)
      zeros.push_back(found.x.back() + (time - found.x.back()) * found.y.back() / (found.y.back() - along));
    found.x.push_back(time);
    found.y.push_back(along);
    exact.x.push_back(time);
    exact.y.push_back(std::cos(omega * time));
  });
  if (!status.ok()) return status;
  if (zeros.size() < 3) return Status{StatusCode::internal, "the wave does not swing"};
  result.figures.push_back(compared("period", zeros[2] - zeros[0], expected, 0.04, "s"));
  picture::LinePlot plot;
  plot.title = "A standing wave";
  plot.x.label = "time, s";
  plot.y.label = "velocity along the mode";
  plot.series = {exact, found};
  result.plots.push_back({"standing_wave", plot});
  return result;
}

}  // namespace bleedsim::lab
