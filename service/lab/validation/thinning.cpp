#include "service/lab/validation/thinning.h"

#include <algorithm>
#include <cmath>

#include "service/lab/validation/cases.h"
#include "service/lab/validation/channel.h"

namespace bleedsim::lab {
namespace {

double viscosityAt(const sph::CassonRheology& law, double g) {
  const double kept = g > 1e-9 ? -std::expm1(-g / law.regularisation_shear_rate) / g : 1.0 / law.regularisation_shear_rate;
  const double root = std::sqrt(law.viscosity) + std::sqrt(law.yield_stress * kept);
  return root * root;
}
double viscosityAt(const sph::CarreauYasudaRheology& law, double g) {
  return law.infinite_shear + (law.zero_shear - law.infinite_shear) *
                                  std::pow(1.0 + std::pow(law.time * g, law.transition), (law.power - 1.0) / law.transition);
}
double viscosityAt(const sph::Rheology& rheology, double g) {
  if (const auto* casson = std::get_if<sph::CassonRheology>(&rheology)) return viscosityAt(*casson, g);
  return viscosityAt(std::get<sph::CarreauYasudaRheology>(rheology), g);
}

/// Of y = 0 to the plate at y = a, through cells of equal width; linear between their middles and 0 at the plate.
double between(const std::vector<double>& cells, double y) {
  const double place = std::min(std::abs(y) / kPlateHalf, 1.0) * static_cast<double>(cells.size()) - 0.5;
  if (place <= 0.0) return cells.front();
  const auto k = std::min(static_cast<std::size_t>(place), cells.size() - 1);
  const double part = place - static_cast<double>(k);
  if (k + 1 == cells.size()) return cells[k] * (1.0 - 2.0 * part);
  return cells[k] + part * (cells[k + 1] - cells[k]);
}

/// Started at its profile the flow must stay; a disturbance dies within (2 a)^2 rho/(pi^2 mu) = 3 s at mu_c, sooner where mu is
/// larger, so a viscosity wrong by 5 % moves it by 2 % in 2 s. Started at nine tenths of it the flow must have come as much
/// closer as flowAfter() says.
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
    const PlaneFlow then = start == 1.0 ? flow : flowAfter(flow, start, (*world)->time());
    const double error = profileError(speeds, scene.spacing, [&](double z) { return then.at(z - kPlateHalf); });
    result.figures.push_back(residual(start == 1.0 ? "l2" : "l2_from_nine_tenths", error, knobs.bound(0.05, 0.02)));
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
  const auto stress = [&](double g) { return g * viscosityAt(law, g); };
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

PlaneFlow flowAfter(const PlaneFlow& flow, double part, double seconds) {
  constexpr int kCells = 200;
  constexpr double kStep = 1e-3;  // s
  const double width = kPlateHalf / kCells;
  std::vector<double> speed(kCells);
  for (int k = 0; k < kCells; ++k) speed[static_cast<std::size_t>(k)] = part * flow.at((k + 0.5) * width);
  std::vector<double> conductance(kCells + 1, 0.0);  // mu/width of the faces, Pa s/m; nothing passes y = 0
  std::vector<double> upper(kCells, 0.0);            // of the elimination from y = 0 on
  const auto steps = static_cast<int>(std::lround(seconds / kStep));
  for (int step = 0; step < steps; ++step) {
    for (std::size_t k = 1; k <= kCells; ++k) {
      const double reach = k < kCells ? width : 0.5 * width;
      const double beyond = k < kCells ? speed[k] : 0.0;
      conductance[k] = viscosityAt(flow.rheology, std::abs(beyond - speed[k - 1]) / reach) / reach;
    }
    const double inertia = kBloodDensity * width / kStep;
    for (std::size_t k = 0; k < kCells; ++k) {
      const double lower = k > 0 ? conductance[k] : 0.0;
      const double pivot = inertia + lower + conductance[k + 1] - (k > 0 ? lower * upper[k - 1] : 0.0);
      upper[k] = conductance[k + 1] / pivot;
      speed[k] = (inertia * speed[k] + flow.gradient * width + (k > 0 ? lower * speed[k - 1] : 0.0)) / pivot;
    }
    for (std::size_t k = kCells - 1; k-- > 0;) speed[k] += upper[k] * speed[k + 1];
  }
  const double largest = speed.front();
  return {flow.gradient, flow.rheology, [speed = std::move(speed)](double y) { return between(speed, y); }, largest};
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
