// Case 8: Taylor-Green vortices at Re = 100: u = U (sin x cos y, -cos x sin y) e^{-2 nu k^2 t}, k = 2 pi/L. A background pressure
// p0 = rho U^2 keeps the clamp p >= 0 from cutting the vortices' low pressures.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

/// The part of the kinetic energy that is not along `mode`, whatever the mode's amplitude.
double energyBeside(const Frame& frame, const VelocityField& mode) {
  double along = 0.0;
  double squares = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const sph::Vec3 wanted = mode(frame.position(i));
    along += frame.velocity(i).dot(wanted);
    squares += wanted.squaredNorm();
    whole += frame.velocity(i).squaredNorm();
  }
  return 1.0 - along * along / (squares * whole);
}

}  // namespace

// The rate between t U/L = 0.5 and 1. Before that the seeded arrangement melts and takes energy that no vortex loses (up to 2.6
// times the rate at t U/L = 0.2).
Result<CaseResult> runTaylorGreen(const Knobs& knobs) {
  constexpr double kSide = 0.02;  // L, m
  constexpr double kSpeed = 0.5;  // U, m/s
  constexpr double kNu = kSpeed * kSide / 100.0;
  sph::WorldDescription scene = emptyScene(knobs, kSide / knobs.across, kSpeed);
  scene.effects.pressure.emplace().background_pressure = kBloodDensity * kSpeed * kSpeed;
  scene.effects.viscosity.emplace().viscosity = kBloodDensity * kNu;
  fillPeriodic(scene, {knobs.across, knobs.across, std::max(9, periodicCount(knobs))}, 0.2);
  const VelocityField vortices = [&](const sph::Vec3& at) -> sph::Vec3 {
    const double x = 2.0 * std::numbers::pi * at.x() / kSide;
    const double y = 2.0 * std::numbers::pi * at.y() / kSide;
    return {kSpeed * std::sin(x) * std::cos(y), -kSpeed * std::cos(x) * std::sin(y), 0.0};
  };
  setFlow(scene, 2, vortices);
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  const double turnover = kSide / kSpeed;
  const double expected = 16.0 * std::numbers::pi * std::numbers::pi * kNu / (kSide * kSide);
  const double start = world->stats().kinetic_energy;
  picture::Series found{"solver", picture::SeriesStyle::line, {}, {}};
  picture::Series exact{"exp(-16 pi^2 nu t/L^2)", picture::SeriesStyle::line, {}, {}};
  const auto sample = [&] {
    if ((*world)->stepCount() % 10 != 0) return;
    const double t = (*world)->time();
    found.x.push_back(t / turnover);
    found.y.push_back(world->stats().kinetic_energy / start);
    exact.x.push_back(t / turnover);
    exact.y.push_back(std::exp(-expected * t));
  };
  if (Status status = world->runFor(0.5 * turnover, sample); !status.ok()) return status;
  const sph::WorldStats middle = world->stats();
  if (Status status = world->runFor(0.5 * turnover, sample); !status.ok()) return status;
  const sph::WorldStats end = world->stats();
  const double rate = std::log(middle.kinetic_energy / end.kinetic_energy) / (end.time - middle.time);
  result.figures.push_back(compared("decay_rate", rate, expected, knobs.bound(0.10, 0.04), "1/s"));
  result.figures.push_back(compared("energy_at_end", end.kinetic_energy / start, std::exp(-expected * end.time), std::nullopt));
  result.figures.push_back(residual("disorder_energy", energyBeside(world->frame(), vortices), std::nullopt));
  picture::LinePlot plot;
  plot.title = "Taylor-Green vortices, Re = 100";
  plot.x.label = "t U/L";
  plot.y = {"KE/KE0", true, {}, {}};
  plot.series = {exact, found};
  result.plots.push_back({"taylor_green", plot});
  return result;
}

}  // namespace bleedsim::lab
