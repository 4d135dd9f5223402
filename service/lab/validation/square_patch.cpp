// Case 14: a square of blood, one layer, that turns as a rigid body in empty space (Colagrossi 2005). Its corners grow into arms;
// no pair force may take angular momentum, but the Brookshaw form of viscosity does, so blood's viscosity acts.
#include <cmath>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {

Result<CaseResult> runSquarePatch(const Knobs& knobs) {
  constexpr double kSide = 0.04;  // m
  constexpr double kRate = 20.0;  // 1/s: 0.57 m/s at the corners
  const double dx = kSide / knobs.across;
  sph::WorldDescription scene = emptyScene(knobs, dx, 0.57);
  scene.planar = true;
  scene.domain.lower = {-2.0 * kSide, -2.0 * kSide, -dx};
  scene.domain.upper = {2.0 * kSide, 2.0 * kSide, dx};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  addBlock(scene, {-0.5 * kSide, -0.5 * kSide, -0.5 * dx}, {knobs.across, knobs.across, 1});
  setFlow(scene, 2, [](const sph::Vec3& at) -> sph::Vec3 { return {-kRate * at.y(), kRate * at.x(), 0.0}; });
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  const auto angular = [&] {
    const Frame frame = world->frame();
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const sph::Vec3 x = frame.position(i);
      const sph::Vec3 v = frame.velocity(i);
      sum += x.x() * v.y() - x.y() * v.x();
    }
    return sum;
  };
  const double before = angular();
  picture::Series found{"solver", picture::SeriesStyle::line, {0.0}, {1.0}};
  const Status status = world->runFor(1.0 / kRate, [&] {
    if ((*world)->stepCount() % 10 != 0) return;
    found.x.push_back(kRate * (*world)->time());
    found.y.push_back(angular() / before);
  });
  if (!status.ok()) return status;
  result.figures.push_back(compared("angular_momentum", angular() / before, 1.0, 0.02));
  picture::LinePlot plot;
  plot.title = "Angular momentum of a turning square";
  plot.x.label = "omega t";
  plot.y = {"over that at the start", false, 0.95, 1.05};
  plot.series = {found};
  result.plots.push_back({"square_patch", plot});
  return result;
}

}  // namespace bleedsim::lab
