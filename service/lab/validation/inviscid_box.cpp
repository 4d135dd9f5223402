// Case 3: inviscid blood keeps its energy. The pressure term is the gradient of the density (16)(20) and of the wall's share, the
// spring that of a potential, and kick-drift-kick is time-reversible. Beside it the paper's kernels, poly6 density with spiky's
// gradient, which is the gradient of no energy: their kinetic energy over that at the start, with (17) and with (16).
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

constexpr double kSide = 0.012;  // m
constexpr double kSpeed = 0.5;   // m/s, the scene's design speed

/// A swirl in the x-z plane that has no flow through the faces: one half turn across the box of walls, whole ones across the
/// periodic one.
sph::WorldDescription swirl(const Knobs& knobs, bool walls) {
  sph::WorldDescription scene = emptyScene(knobs, kSide / knobs.across, kSpeed);
  scene.effects.pressure.emplace();
  const Counts counts{knobs.across, knobs.across, knobs.across};
  if (walls)
    fillBox(scene, counts, 0.05);
  else
    fillPeriodic(scene, counts, 0.05);
  const double k = (walls ? 1.0 : 2.0) * std::numbers::pi / kSide;
  setFlow(scene, 1, [k](const sph::Vec3& at) -> sph::Vec3 {
    return {kSpeed * std::sin(k * at.x()) * std::cos(k * at.z()), 0.0, -kSpeed * std::cos(k * at.x()) * std::sin(k * at.z())};
  });
  return scene;
}

struct Kept {
  double whole = 0.0;    ///< energyOf() over that at the start
  double kinetic = 0.0;  ///< the same of the kinetic energy
};
Result<Kept> keptBy(const sph::WorldDescription& scene, const Knobs& knobs, RunCost& cost, picture::Series* curve) {
  auto world = CaseWorld::create(scene, knobs, cost);
  if (!world) return world.status();
  const double whole = energyOf(**world);
  const double kinetic = world->stats().kinetic_energy;
  const double unit = scene.spacing / (*world)->speedOfSound();
  const Status status = world->runFor(200.0 * unit, [&] {
    if (curve == nullptr || (*world)->stepCount() % 20 != 0) return;
    curve->x.push_back((*world)->time() / unit);
    curve->y.push_back(world->stats().kinetic_energy / kinetic);
  });
  if (!status.ok()) return status;
  return Kept{energyOf(**world) / whole, world->stats().kinetic_energy / kinetic};
}

/// The paper's equations as printed, in the same box.
sph::WorldDescription literalOf(sph::WorldDescription scene, sph::PressureForm form) {
  scene.model = sph::Model::literal;
  scene.literal.pressure = form;
  return scene;
}

}  // namespace

Result<CaseResult> runInviscidBox(const Knobs& knobs) {
  CaseResult result;
  picture::LinePlot plot;
  plot.title = "Kinetic energy of an inviscid swirl";
  plot.x.label = "t c0/dx";
  plot.y = {"over that at the start", true, {}, {}};
  for (const bool walls : {false, true}) {
    const std::string name = walls ? "walls" : "periodic";
    const sph::WorldDescription scene = swirl(knobs, walls);
    picture::Series sound{"sound, " + name, picture::SeriesStyle::line, {}, {}};
    const auto kept = keptBy(scene, knobs, result.cost, &sound);
    if (!kept) return kept.status();
    result.figures.push_back(compared(name + "_energy", kept->whole, 1.0, walls ? 1e-2 : 1e-3));
    plot.series.push_back(sound);
    for (const sph::PressureForm form : {sph::PressureForm::symmetric, sph::PressureForm::variational}) {
      if (!knobs.beside || knobs.precision == sph::Precision::float64) continue;
      const char* printed = form == sph::PressureForm::symmetric ? "17" : "16";
      picture::Series literal{fmt::format("literal ({}), {}", printed, name), picture::SeriesStyle::line, {}, {}};
      RunCost aside;
      const auto grown = keptBy(literalOf(scene, form), knobs, aside, &literal);
      if (!grown) {
        result.notes.push_back(fmt::format("literal ({}), {}: {}", printed, name, grown.status().message()));
        continue;
      }
      result.figures.push_back(compared(fmt::format("literal_{}_{}_kinetic", printed, name), grown->kinetic, 1.0, std::nullopt));
      plot.series.push_back(literal);
    }
  }
  result.plots.push_back({"inviscid_box", plot});
  return result;
}

}  // namespace bleedsim::lab
