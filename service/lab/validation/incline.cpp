// Case 13: a film on a slope of 30 degrees, H = 3 mm, mu = 0.1 Pa s: u_s = rho g sin(30) H^2/(2 mu) = 0.234 m/s, q = u_s H 2/3 =
// 4.68e-4 m^2/s.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {

// Half of the knobs' rows: 10 of 20. The surface row's middle is half a spacing below the surface; surface_speed is that of the
// fastest particle over the profile's speed there.
Result<CaseResult> runIncline(const Knobs& knobs) {
  constexpr double kDepth = 0.003;    // m
  constexpr double kViscosity = 0.1;  // Pa s
  const int rows = knobs.across / 2;
  const double angle = std::numbers::pi / 6.0;
  sph::WorldDescription scene =
      channelScene(knobs, rows, kDepth, false, kGravity * sph::Vec3{std::sin(angle), 0, -std::cos(angle)}, 0.234);
  scene.effects.viscosity->viscosity = kViscosity;
  scene.effects.viscosity->solve = sph::ViscositySolve::automatic;
  scene.compressibility.max_fall_or_depth = kDepth;
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  if (Status status = world->runFor(0.25); !status.ok()) return status;
  const double surface = kBloodDensity * kGravity * std::sin(angle) * kDepth * kDepth / (2.0 * kViscosity);
  const Profile exact = [&](double z) { return surface * (1.0 - (1.0 - z / kDepth) * (1.0 - z / kDepth)); };
  const sph::WorldStats stats = world->stats();
  const int side = periodicCount(knobs);
  const double flow = stats.momentum.x() / (kBloodDensity * side * side * scene.spacing * scene.spacing);
  const double bound = knobs.bound(0.08, 0.04);
  result.figures.push_back(compared("surface_speed", stats.max_speed, exact(kDepth - 0.5 * scene.spacing), bound, "m/s"));
  result.figures.push_back(compared("flow", flow, surface * kDepth * 2.0 / 3.0, bound, "m^2/s"));
  const std::vector<double> speeds = rowSpeeds(**world, rows);
  result.figures.push_back(residual("profile_l2", profileError(speeds, scene.spacing, exact), bound));
  picture::LinePlot plot;
  plot.title = "A film on a slope of 30 degrees";
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  addProfile(plot, "after 0.25 s", speeds, scene.spacing, exact);
  result.plots.push_back({"incline", plot});
  return result;
}

}  // namespace bleedsim::lab
