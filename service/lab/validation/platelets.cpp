// Case 12: platelets against closed forms.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

constexpr double kLength = 0.04;  // m, of the box along x

double sumOfPlatelets(const sph::World& world) {
  const Frame frame = frameOf(world);
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) sum += frame.platelet(i);
  return sum;
}

/// Blood at rest with periodic sides, no sinks, and no viscosity, which at P = 0 would take tiny steps.
sph::WorldDescription still(const Knobs& knobs, double spacing, double diffusivity) {
  sph::WorldDescription scene = emptyScene(knobs, spacing, 0.01);
  scene.effects.pressure.emplace();
  sph::PlateletSettings& platelets = scene.effects.platelets.emplace();
  platelets.diffusivity = diffusivity;
  platelets.activation_rate = 0.0;
  platelets.wall_rate = 0.0;
  platelets.air_rate = 0.0;
  return scene;
}

}  // namespace

// A step from 1 to 0 at x = 0: P = erfc(x/(2 sqrt(k t)))/2. sqrt(4 k t) is an eighth of the box, far from the other step. L2 of
// the rows. The exchange of a pair is equal and opposite, so the sum of P stays.
Result<CaseResult> runPlateletSpread(const Knobs& knobs) {
  constexpr double kDiffusivity = 1e-6;  // m^2/s
  const int rows = 2 * knobs.across;
  const double dx = kLength / rows;
  const int side = std::max(9, periodicCount(knobs));
  sph::WorldDescription scene = still(knobs, dx, kDiffusivity);
  fillPeriodic(scene, {rows, side, side}, 0.0);
  sph::FluidBlock fresh = scene.fluid_blocks[0];
  sph::FluidBlock empty = fresh;
  const double middle = 0.5 * kLength;
  fresh.upper.x() = middle;
  fresh.platelet = 1.0;
  empty.lower.x() = middle;
  empty.platelet = 0.0;
  scene.fluid_blocks = {fresh, empty};
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  const double before = sumOfPlatelets(**world);
  const double reach = kLength / 8.0;
  if (Status status = world->runFor(reach * reach / (4.0 * kDiffusivity)); !status.ok()) return status;
  const double spread = 2.0 * std::sqrt(kDiffusivity * (*world)->time());
  const Frame frame = world->frame();
  RelativeL2 error;
  picture::Series found{"solver", picture::SeriesStyle::points, {}, {}};
  picture::Series exact{"erfc(x/(2 sqrt(k t)))/2", picture::SeriesStyle::line, {}, {}};
  for (int row = rows / 4; row < 3 * rows / 4; ++row) {
    const double x = (row + 0.5) * dx - middle;
    const double value = layerMean(frame, dx, 0, row, [&](std::size_t i) { return frame.platelet(i); });
    const double wanted = 0.5 * std::erfc(x / spread);
    error.add(value, wanted);
    found.x.push_back(x);
    found.y.push_back(value);
    exact.x.push_back(x);
    exact.y.push_back(wanted);
  }
  double beyond = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) beyond = std::max({beyond, -frame.platelet(i), frame.platelet(i) - 1.0});
  result.figures.push_back(residual("l2", error.value(), knobs.bound(0.03, 0.01)));
  result.figures.push_back(residual("beyond_0_to_1", beyond, 0.0));
  result.figures.push_back(compared("sum", sumOfPlatelets(**world), before, 1e-6, "particles"));
  picture::LinePlot plot;
  plot.title = "Diffusion of a step of P";
  plot.x.label = "x, m";
  plot.y = {"P", false, {}, {}};
  plot.series = {exact, found};
  result.plots.push_back({"platelet_spread", plot});
  return result;
}

// dP/dt = -r P (1 - P) from 0.99: logit P = ln 99 - r t, so P = 1/2 at t50 = ln 99/r; `clot_speedup` multiplies r.
Result<CaseResult> runPlateletActivation(const Knobs& knobs) {
  constexpr double kRate = 40.0;  // 1/s
  CaseResult result;
  picture::LinePlot plot;
  plot.title = "Clotting at rest";
  plot.x.label = "r t";
  plot.y = {"P", false, {}, {}};
  picture::Series exact{"logistic", picture::SeriesStyle::line, {}, {}};
  for (int k = 0; k <= 50; ++k) {
    exact.x.push_back(0.1 * k);
    exact.y.push_back(1.0 / (1.0 + std::exp(exact.x.back() - std::log(99.0))));
  }
  plot.series.push_back(exact);
  for (const double speedup : {1.0, 10.0}) {
    sph::WorldDescription scene = still(knobs, 0.001, 1e-9);
    const int side = periodicCount(knobs);
    fillPeriodic(scene, {side, side, side}, 0.0);
    scene.effects.platelets->activation_rate = kRate;
    scene.effects.platelets->clot_speedup = speedup;
    auto world = CaseWorld::create(scene, knobs, result.cost);
    if (!world) return world.status();
    picture::Series found{fmt::format("clot_speedup {:.0f}", speedup), picture::SeriesStyle::points, {}, {}};
    double platelet = 1.0;
    double before = 1.0;
    double last = 0.0;
    while (platelet > 0.5) {
      if (kRate * speedup * (*world)->time() > 20.0) return Status{StatusCode::internal, "P does not fall to 1/2"};
      before = platelet;
      const double start = (*world)->time();
      if (Status status = world->step(1e-4 / speedup); !status.ok()) return status;
      last = (*world)->time() - start;
      platelet = sumOfPlatelets(**world) / (*world)->particleCount();
      if ((*world)->stepCount() % 100 != 0) continue;
      found.x.push_back(kRate * speedup * (*world)->time());
      found.y.push_back(platelet);
    }
    const double half = (*world)->time() - last * (0.5 - platelet) / (before - platelet);
    result.figures.push_back(
        compared(fmt::format("t50_speedup_{:.0f}", speedup), half, std::log(99.0) / (kRate * speedup), 0.02, "s"));
    plot.series.push_back(found);
  }
  result.plots.push_back({"platelet_activation", plot});
  return result;
}

}  // namespace bleedsim::lab
