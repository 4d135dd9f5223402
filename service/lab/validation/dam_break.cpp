// Case 10: a column of water, 2 a high and a wide, collapses. Martin & Moyce 1952, n^2 = 2, a = 57.15 mm; their front as
// digitised by others. The front's position does not discriminate accuracy, so the case is no measure of it.
#include <algorithm>
#include <array>
#include <cmath>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

constexpr double kWidth = 0.05715;  // a, m
constexpr std::array kTime{0.41, 0.84, 1.19, 1.43, 1.63, 1.83, 1.98, 2.20, 2.32, 2.51, 2.65, 2.83, 2.98, 3.11, 3.33};
constexpr std::array kFront{1.11, 1.22, 1.44, 1.67, 1.89, 2.11, 2.33, 2.56, 2.78, 3.00, 3.22, 3.44, 3.67, 3.89, 4.11};

/// Of the points (x, y) at `at`; the ends beyond them.
double between(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto upper = std::upper_bound(x.begin(), x.end(), at);
  if (upper == x.begin()) return y.front();
  if (upper == x.end()) return y.back();
  const auto k = static_cast<std::size_t>(upper - x.begin());
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

/// Where the `row`-th particle from the front stands, over a: a lone one ahead is no front.
double frontOf(const sph::World& world, int row) {
  const Frame frame = frameOf(world);
  std::vector<double> x;
  for (std::size_t i = 0; i < frame.size(); ++i) x.push_back(frame.position(i).x());
  std::nth_element(x.begin(), x.begin() + row, x.end(), std::greater<>{});
  return (x[static_cast<std::size_t>(row)] + 0.5 * world.description().spacing) / kWidth;
}

struct Fit {
  double rms = 0.0;
  double shift = 0.0;
};
/// The smallest root mean square difference in Z over shifts of T by at most 0.3: when the column was free is not known.
Fit bestFit(const std::vector<double>& time, const std::vector<double>& front) {
  Fit best{1e300, 0.0};
  for (int k = -60; k <= 60; ++k) {
    const double shift = 0.005 * k;
    double squares = 0.0;
    for (std::size_t m = 0; m < kTime.size(); ++m) {
      const double difference = between(time, front, kTime[m] + shift) - kFront[m];
      squares += difference * difference;
    }
    const double rms = std::sqrt(squares / static_cast<double>(kTime.size()));
    if (rms < best.rms) best = {rms, shift};
  }
  return best;
}

/// Slip of floor and wall. At this spacing a boundary layer, 1 mm thick after 0.1 s, is thinner than a row of particles.
Result<picture::Series> runFront(double slip, const Knobs& knobs, RunCost& cost) {
  const double dx = kWidth / knobs.across;
  const int side = periodicCount(knobs);
  sph::WorldDescription scene = emptyScene(knobs, dx, 0.3);
  scene.rest_density = 1000.0;
  scene.compressibility.max_fall_or_depth = 2.0 * kWidth;
  scene.domain.lower = {-8.0 * dx, 0.0, -8.0 * dx};
  scene.domain.upper = {6.0 * kWidth, side * dx, 3.0 * kWidth};
  scene.domain.periodic = {false, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().viscosity = 0.001;
  scene.effects.gravity.emplace();
  scene.tissue.push_back({.name = "floor", .shape = sph::PlaneShape{}, .slip = slip});
  scene.tissue.push_back(
      {.name = "wall", .shape = sph::PlaneShape{.point = sph::Vec3::Zero(), .normal = {1, 0, 0}}, .slip = slip});
  addBlock(scene, sph::Vec3::Zero(), {knobs.across, side, 2 * knobs.across});
  auto world = CaseWorld::create(scene, knobs, cost);
  if (!world) return world.status();
  const double unit = std::sqrt(kWidth / (2.0 * kGravity));
  picture::Series series{"", picture::SeriesStyle::line, {0.0}, {1.0}};
  const Status status = world->runFor(3.65 * unit, [&] {
    if ((*world)->stepCount() % 20 != 0) return;
    series.x.push_back((*world)->time() / unit);
    series.y.push_back(frontOf(**world, side));
  });
  if (!status.ok()) return status;
  return series;
}

}  // namespace

Result<CaseResult> runDamBreak(const Knobs& knobs) {
  CaseResult result;
  picture::LinePlot plot;
  plot.title = "Front of a collapsing column";
  plot.x.label = "T = t sqrt(2 g/a)";
  plot.y.label = "Z = x/a";
  plot.series = {
      {"Martin & Moyce 1952", picture::SeriesStyle::points, {kTime.begin(), kTime.end()}, {kFront.begin(), kFront.end()}}};
  for (const double slip : {1.0, 0.0}) {
    if (slip == 0.0 && !knobs.beside) continue;
    RunCost aside;
    auto series = runFront(slip, knobs, slip == 1.0 ? result.cost : aside);
    if (!series) return series.status();
    const Fit fit = bestFit(series->x, series->y);
    const std::string name = slip == 1.0 ? "free_slip" : "no_slip";
    result.figures.push_back(residual("rms_" + name, fit.rms, slip == 1.0 ? std::optional{0.06} : std::optional<double>{}));
    result.figures.push_back(residual("shift_" + name, fit.shift, slip == 1.0 ? std::optional{0.3} : std::optional<double>{}));
    series->name = slip == 1.0 ? "free slip" : "no slip";
    plot.series.push_back(*series);
  }
  result.plots.push_back({"dam_break", plot});
  return result;
}

}  // namespace bleedsim::lab
