#include "service/lab/validation/thinning.h"

#include <algorithm>
#include <cmath>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {
namespace {

/// Started at its profile the flow must stay; a disturbance dies within (2 a)^2 rho/(pi^2 mu) = 3 s at mu_c, sooner where mu is
/// larger, so a viscosity wrong by 5 % moves it by 2 % in 2 s. Started at nine tenths of it the flow must have come closer.
Result<CaseResult> runPlates(const PlaneFlow& flow, const Knobs& knobs, const std::string& name, const std::string& title) {
  CaseResult result;
  picture::LinePlot plot;
  plot.title = title;
  plot.x.label = "height, m";
  plot.y.label = "speed, m/s";
  const Profile exact = [&](double z) { return flow.at(z - kPlateHalf); };
  for (const double start : {1.0, 0.9}) {
    sph::WorldDescription scene =
        channelScene(knobs, knobs.across, 2.0 * kPlateHalf, true, {flow.gradient / kBloodDensity, 0, 0}, flow.largest);
    scene.effects.viscosity->rheology = flow.rheology;
    setFlow(scene, 1, [&](const sph::Vec3& at) -> sph::Vec3 { return {start * exact(at.z()), 0, 0}; });
    auto world = CaseWorld::create(scene, knobs, result.cost);
    if (!world) return world.status();
    if (Status status = world->runFor(2.0); !status.ok()) return status;
    const std::vector<double> speeds = rowSpeeds(**world, knobs.across);
    result.figures.push_back(residual(start == 1.0 ? "l2" : "l2_from_nine_tenths", profileError(speeds, scene.spacing, exact),
                                      knobs.bound(0.05, 0.02)));
    if (start == 1.0) addProfile(plot, "after 2 s", speeds, scene.spacing, exact);
  }
  result.plots.push_back({name, plot});
  return result;
}

}  // namespace

PlaneFlow cassonFlow() {
  const sph::CassonRheology law;
  const auto at = [law](double y) {
    const double g = 10.0;
    const double r = std::max(std::abs(y), law.yield_stress / g);
    return (0.5 * g * (kPlateHalf * kPlateHalf - r * r) + law.yield_stress * (kPlateHalf - r) -
            4.0 / 3.0 * std::sqrt(law.yield_stress * g) * (std::pow(kPlateHalf, 1.5) - std::pow(r, 1.5))) /
           law.viscosity;
  };
  return {10.0, law, at, at(0.0)};
}

PlaneFlow carreauFlow() {
  constexpr int kNodes = 2000;
  const sph::CarreauYasudaRheology law;
  const double gradient = 22.81;
  const auto stress = [&](double g) {
    return g *
           (law.infinite_shear + (law.zero_shear - law.infinite_shear) *
                                     std::pow(1.0 + std::pow(law.time * g, law.transition), (law.power - 1.0) / law.transition));
  };
  std::vector<double> speed(kNodes + 1, 0.0);
  for (int k = kNodes - 1; k >= 0; --k) {
    double low = 0.0;
    double high = 1000.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (stress(middle) < gradient * kPlateHalf * (k + 0.5) / kNodes ? low : high) = middle;
    }
    speed[static_cast<std::size_t>(k)] = speed[static_cast<std::size_t>(k) + 1] + low * kPlateHalf / kNodes;
  }
  const double largest = speed[0];
  const auto at = [speed = std::move(speed)](double y) {
    const double node = std::min(std::abs(y) / kPlateHalf, 1.0) * kNodes;
    const auto k = static_cast<std::size_t>(std::min(node, kNodes - 1.0));
    return speed[k] + (node - static_cast<double>(k)) * (speed[k + 1] - speed[k]);
  };
  return {gradient, law, at, largest};
}

double meanSpeed(const PlaneFlow& flow) {
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) sum += flow.at(kPlateHalf * (k + 0.5) / kSteps);
  return sum / kSteps;
}

Result<CaseResult> runCasson(const Knobs& knobs) {
  return runPlates(cassonFlow(), knobs, "casson", "Casson blood between plates");
}
Result<CaseResult> runCarreau(const Knobs& knobs) {
  return runPlates(carreauFlow(), knobs, "carreau", "Carreau blood between plates");
}

}  // namespace bleedsim::lab
