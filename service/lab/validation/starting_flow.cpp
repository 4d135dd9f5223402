// Cases 5 and 6: flows between planes that start from rest. Morris, Fox & Zhu 1997: L = 1 mm, nu = 1e-6 m^2/s.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {
namespace {

constexpr double kLength = 0.001;   // L, m
constexpr double kNu = 1e-6;        // m^2/s
constexpr double kForce = 1e-4;     // F of case 5, m/s^2
constexpr double kSpeed = 1.25e-5;  // U of case 6 and the steady middle of case 5, m/s

/// Of the speed of sound, m/s. Morris, Fox & Zhu ask for c^2 >= max(V^2, nu V/L, F L)/delta, delta the compression, 1/Mach^2
/// here. By V alone sound would be slower than viscosity is here, and the solver would cut the accelerations at the walls.
double designSpeed(double force) { return std::sqrt(std::max({kSpeed * kSpeed, kNu * kSpeed / kLength, force * kLength})); }

struct Moment {
  double time;         // s
  double morris;       // at mid-plane, m/s, as printed
  const char* suffix;  // of figures
};

/// Of the middle between two rows, by the cubic through the four next to it, m/s.
double middleOf(const std::vector<double>& rows) {
  const std::size_t upper = rows.size() / 2;
  if (rows.size() % 2 == 1) return rows[upper];
  return (9.0 * (rows[upper - 1] + rows[upper]) - rows[upper - 2] - rows[upper + 1]) / 16.0;
}

/// u = F/(2 nu) z (L - z) - sum_n 4 F L^2/(nu pi^3 (2n+1)^3) sin(pi z (2n+1)/L) exp(-(2n+1)^2 pi^2 nu t/L^2)
double poiseuilleAt(double z, double t) {
  const double pi = std::numbers::pi;
  double speed = kForce / (2.0 * kNu) * z * (kLength - z);
  for (int n = 0; n < 30; ++n) {
    const double k = 2.0 * n + 1.0;
    speed -= 4.0 * kForce * kLength * kLength / (kNu * pi * pi * pi * k * k * k) * std::sin(pi * z * k / kLength) *
             std::exp(-k * k * pi * pi * kNu * t / (kLength * kLength));
  }
  return speed;
}

/// u = U z/L + sum_n 2 U/(n pi) (-1)^n sin(n pi z/L) exp(-nu n^2 pi^2 t/L^2)
double couetteAt(double z, double t) {
  const double pi = std::numbers::pi;
  double speed = kSpeed * z / kLength;
  for (int n = 1; n < 60; ++n) {
    speed += (n % 2 == 0 ? 2.0 : -2.0) * kSpeed / (n * pi) * std::sin(n * pi * z / kLength) *
             std::exp(-kNu * n * n * pi * pi * t / (kLength * kLength));
  }
  return speed;
}

/// Runs `world` through the moments; `rows_at` gives the rows' speeds, `exact` what they should be.
Status follow(CaseWorld& world, const std::array<Moment, 4>& moments, const Knobs& knobs,
              const std::function<std::vector<double>()>& rows_at, double (*exact)(double, double), picture::LinePlot& plot,
              CaseResult& result) {
  const double dx = world->description().spacing;
  for (const Moment& moment : moments) {
    if (Status status = world.runFor(moment.time - world->time()); !status.ok()) return status;
    const std::vector<double> rows = rows_at();
    const Profile profile = [&](double z) { return exact(z, world->time()); };
    result.figures.push_back(
        residual(fmt::format("l2_at_{}_s", moment.suffix), profileError(rows, dx, profile), knobs.bound(0.03, 0.01)));
    result.figures.push_back(
        compared(fmt::format("middle_at_{}_s", moment.suffix), middleOf(rows), moment.morris, knobs.bound(0.03, 0.01), "m/s"));
    addProfile(plot, fmt::format("{} s", moment.time), rows, dx, profile);
  }
  return {};
}

/// What the paper's viscosity, (25) with the Laplacian of (33) and each particle's own mu, makes of the steady flow.
void addLiteral(const sph::WorldDescription& scene, const Knobs& knobs, CaseResult& result) {
  sph::WorldDescription literal = scene;
  literal.model = sph::Model::literal;
  literal.effects.viscosity->solve = sph::ViscositySolve::automatic;
  RunCost aside;
  auto world = CaseWorld::create(literal, knobs, aside);
  Status status = world ? world->runFor(0.7) : world.status();
  if (!status.ok()) {
    result.notes.push_back("literal: " + status.message());
    return;
  }
  result.figures.push_back(residual("literal_l2_steady",
                                    profileError(rowSpeeds(**world, knobs.across), scene.spacing,
                                                 [](double z) { return kForce / (2.0 * kNu) * z * (kLength - z); }),
                                    std::nullopt));
}

}  // namespace

Result<CaseResult> runPoiseuille(const Knobs& knobs) {
  constexpr std::array kMoments{Moment{0.0225, 2.233e-6, "0_0225"}, Moment{0.045, 4.235e-6, "0_045"},
                                Moment{0.1125, 8.250e-6, "0_1125"}, Moment{0.225, 1.110e-5, "0_225"}};
  sph::WorldDescription scene = channelScene(knobs, knobs.across, kLength, true, {kForce, 0, 0}, designSpeed(kForce));
  scene.effects.viscosity->viscosity = kNu * kBloodDensity;
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  picture::LinePlot plot;
  plot.title = "Poiseuille flow from rest";
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  const auto rows = [&] { return rowSpeeds(**world, knobs.across); };
  if (Status status = follow(*world, kMoments, knobs, rows, poiseuilleAt, plot, result); !status.ok()) return status;
  if (Status status = world->runFor(0.7 - (*world)->time()); !status.ok()) return status;
  const Profile steady = [&](double z) { return poiseuilleAt(z, (*world)->time()); };
  result.figures.push_back(residual("l2_steady", profileError(rows(), scene.spacing, steady), knobs.bound(0.03, 0.01)));
  result.figures.push_back(compared("middle_steady", middleOf(rows()), kSpeed, knobs.bound(0.03, 0.01), "m/s"));
  addProfile(plot, "0.7 s", rows(), scene.spacing, steady);
  if (knobs.beside && knobs.precision == sph::Precision::float32) addLiteral(scene, knobs, result);
  result.plots.push_back({"poiseuille", plot});
  return result;
}

// The solver has no moving plane. What runs is the flow less its steady state U z/L: the same linear problem with planes at rest,
// begun at -U z/L. Viscosity, friction at walls and advection along x do not see the difference.
Result<CaseResult> runCouette(const Knobs& knobs) {
  constexpr std::array kMoments{Moment{0.0225, 2.303e-7, "0_0225"}, Moment{0.045, 1.195e-6, "0_045"},
                                Moment{0.1125, 3.628e-6, "0_1125"}, Moment{0.225, 5.386e-6, "0_225"}};
  sph::WorldDescription scene = channelScene(knobs, knobs.across, kLength, true, sph::Vec3::Zero(), designSpeed(0.0));
  scene.effects.viscosity->viscosity = kNu * kBloodDensity;
  setFlow(scene, 1, [](const sph::Vec3& at) -> sph::Vec3 { return {-kSpeed * at.z() / kLength, 0.0, 0.0}; });
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  picture::LinePlot plot;
  plot.title = "Couette flow from rest";
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  const auto rows = [&] {
    std::vector<double> speeds = rowSpeeds(**world, knobs.across);
    for (std::size_t row = 0; row < speeds.size(); ++row)
      speeds[row] += kSpeed * (static_cast<double>(row) + 0.5) * scene.spacing / kLength;
    return speeds;
  };
  if (Status status = follow(*world, kMoments, knobs, rows, couetteAt, plot, result); !status.ok()) return status;
  result.plots.push_back({"couette", plot});
  return result;
}

}  // namespace bleedsim::lab
