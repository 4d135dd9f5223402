// The implicit solve where the explicit limit would rule the time step: steady flow between planes L apart, u = rho F/(2 mu) z (L
// - z); mu = 10 Pa s, L = 12 mm, F = 100 m/s^2 give 0.19 m/s in the middle after a few L^2/nu = 15 ms. The central form depends
// on direction where particles stand in rows, as they do in a channel: an axis-aligned shear of a lattice needs 1.78 / 1.22
// / 1.11 times the viscosity at h = 2 / 2.5 / 3 dx (physics.md section 2).
#include <algorithm>
#include <cmath>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {

Result<CaseResult> runThickBlood(const Knobs& knobs) {
  constexpr double kViscosity = 10.0;           // Pa s
  constexpr double kForce = 100.0;              // m/s^2
  constexpr double kLength = 0.012;             // m
  const int rows = (3 * knobs.across + 2) / 5;  // 12 of 20
  sph::WorldDescription scene = channelScene(knobs, rows, kLength, true, {kForce, 0, 0}, 0.2);
  scene.fluid_blocks.clear();
  scene.capacity = 0;
  const int side = std::max(10, periodicCount(knobs));
  scene.domain.upper.x() = side * scene.spacing;
  scene.domain.upper.y() = side * scene.spacing;
  addBlock(scene, sph::Vec3::Zero(), {side, side, rows});
  scene.fluid_blocks.back().jitter = 0.3;
  sph::ViscositySettings& viscosity = *scene.effects.viscosity;
  viscosity.viscosity = kViscosity;
  viscosity.solve = sph::ViscositySolve::implicit;
  viscosity.solve_tolerance = 1e-4;
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  if (Status status = world->runFor(0.05); !status.ok()) return status;
  const Profile exact = [&](double z) { return kBloodDensity * kForce / (2.0 * kViscosity) * z * (kLength - z); };
  const std::vector<double> speeds = rowSpeeds(**world, rows);
  result.figures.push_back(residual("l2", profileError(speeds, scene.spacing, exact), std::nullopt));
  const double limit = 0.045 * std::pow(scene.supportRadius(), 2) * kBloodDensity / kViscosity;
  result.figures.push_back({"step_over_explicit_limit", world->stats().dt / limit, std::nullopt, 0.0, std::nullopt, {}});
  result.figures.push_back(
      residual("unsolved_steps", static_cast<double>(world->counter(sph::Counter::viscosity_unsolved)), 0.0));
  picture::LinePlot plot;
  plot.title = "Thick blood between planes, implicit solve";
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  addProfile(plot, "after 0.05 s", speeds, scene.spacing, exact);
  result.plots.push_back({"thick_blood", plot});
  return result;
}

}  // namespace bleedsim::lab
