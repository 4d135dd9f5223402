// Case 6, the layers: unlike blood in contact. The stress between two layers is continuous; the harmonic mean of their
// viscosities makes it exact (physics.md section 1).
#include <cmath>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {
namespace {

/// Two layers, mu 1:10, under one body force: the stress rho F (z* - z) is continuous, so with a = L/2
///   lower: u = F/nu1 (z* z - z^2/2)     upper: u = F/nu2 ((L^2 - z^2)/2 - z* (L - z))
///   equal at a: z* = (a^2/(2 nu1) + (L^2 - a^2)/(2 nu2)) / (a/nu1 + (L - a)/nu2)
Status drivenLayers(const Knobs& knobs, CaseResult& result) {
  constexpr double kLength = 0.001;  // m
  constexpr double kForce = 1e-4;    // m/s^2
  constexpr double kNuLower = 1e-6;  // m^2/s
  constexpr double kNuUpper = 1e-5;
  const int rows = 2 * ((3 * knobs.across + 5) / 10);  // 12 of 20: each layer has whole rows
  sph::WorldDescription scene = channelScene(knobs, rows, kLength, true, {kForce, 0, 0}, 1.25e-5);
  scene.effects.viscosity->viscosity = kNuLower * kBloodDensity;
  scene.fluid_blocks.clear();
  scene.capacity = 0;
  const int side = periodicCount(knobs);
  addBlock(scene, sph::Vec3::Zero(), {side, side, rows / 2});
  addBlock(scene, {0, 0, 0.5 * kLength}, {side, side, rows / 2});
  scene.fluid_blocks.back().viscosity = kNuUpper * kBloodDensity;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  if (Status status = world->runFor(0.8); !status.ok()) return status;
  const double a = 0.5 * kLength;
  const double turn =
      (a * a / (2.0 * kNuLower) + (kLength * kLength - a * a) / (2.0 * kNuUpper)) / (a / kNuLower + (kLength - a) / kNuUpper);
  const Profile exact = [&](double z) {
    if (z < a) return kForce / kNuLower * (turn * z - 0.5 * z * z);
    return kForce / kNuUpper * (0.5 * (kLength * kLength - z * z) - turn * (kLength - z));
  };
  const std::vector<double> speeds = rowSpeeds(**world, rows);
  result.figures.push_back(residual("profile_l2", profileError(speeds, scene.spacing, exact), knobs.bound(0.03, 0.01)));
  picture::LinePlot plot;
  plot.title = "Two layers, 1:10, under one body force";
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  addProfile(plot, "two layers", speeds, scene.spacing, exact);
  result.plots.push_back({"layers", plot});
  return {};
}

/// A plane Couette flow of two layers, mu 1:100, the stress tau in both: u = tau z/mu_k on either side of z = 0. The pairs within
/// the lower layer cancel, so its force is the stress of the upper one, tau x area; its own lower face is free. A particle stands
/// for rho0 dx^3 of blood (its calibrated mass is that over the kernel's lattice sum). The arithmetic mean would be 25 times too
/// large.
Status interfaceStress(const Knobs& knobs, CaseResult& result) {
  constexpr double kSpacing = 0.001;  // m
  constexpr double kThin = 0.004;     // Pa s
  constexpr double kThick = 0.4;      // Pa s
  constexpr double kStress = 0.02;    // Pa
  const int side = periodicCount(knobs);
  sph::WorldDescription scene = emptyScene(knobs, kSpacing, 0.5);
  scene.domain.periodic = {true, true, false};
  scene.domain.lower = {0, 0, -0.02};
  scene.domain.upper = {side * kSpacing, side * kSpacing, 0.02};
  scene.effects.viscosity.emplace().solve = sph::ViscositySolve::explicit_;
  addBlock(scene, {0, 0, -8 * kSpacing}, {side, side, 16});
  setFlow(scene, 1, [](const sph::Vec3& at) -> sph::Vec3 { return {kStress / (at.z() < 0.0 ? kThin : kThick) * at.z(), 0, 0}; });
  std::vector<double> heights;
  for (sph::FluidBlock& block : scene.fluid_blocks) {
    const bool lower = block.lower.z() < -0.5 * kSpacing;
    block.viscosity = lower ? kThin : kThick;
    for (int k = 0; k < side; ++k) heights.push_back(block.lower.z());
  }
  sph::WorldOptions options = knobs.options();
  options.precision = sph::Precision::float64;  // the forces are small against the velocities
  const auto acceleration = accelerationsOf(scene, options, 5e-5);
  if (!acceleration) return acceleration.status();
  double force = 0.0;
  for (std::size_t i = 0; i < acceleration->size(); ++i) {
    if (heights[i] < -0.5 * kSpacing) force += kBloodDensity * scene.particleVolume() * (*acceleration)[i].x();
  }
  const double area = side * side * kSpacing * kSpacing;
  result.figures.push_back(compared("interface_stress", force / area, kStress, 0.02, "Pa"));
  return {};
}

}  // namespace

Result<CaseResult> runLayers(const Knobs& knobs) {
  CaseResult result;
  if (Status status = drivenLayers(knobs, result); !status.ok()) return status;
  if (Status status = interfaceStress(knobs, result); !status.ok()) return status;
  return result;
}

}  // namespace bleedsim::lab
