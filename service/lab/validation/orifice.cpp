// Case 11: the orifice law of pressure-driven wounds, 2 mm wide, at 10 and 100 mmHg, and an orifice that particles resolve.
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"
#include "service/status/units.h"

namespace bleedsim::lab {
namespace {

using sph::Vec3;

constexpr double kLeastCd = 0.61;  // sharp edge
constexpr double kMostCd = 0.97;   // rounded

/// 1 mm, half of the wound, at 20 across.
double spacingOf(const Knobs& knobs) { return 0.02 / knobs.across; }

/// What a wound brings in `seconds`, over the integral of its flow; the flow goes to `flow`, m^3/s.
Result<double> emittedBy(double pressure, double coefficient, const Knobs& knobs, RunCost& cost, double& flow) {
  constexpr double kSeconds = 0.1;
  sph::WorldDescription scene = emptyScene(knobs, spacingOf(knobs), 0.3);
  scene.capacity = static_cast<std::uint32_t>(2e-6 / scene.particleVolume());
  scene.domain.lower = {-0.02, -0.02, -0.01};
  scene.domain.upper = {0.02, 0.02, 0.03};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.tissue.push_back({.name = "tissue", .shape = sph::PlaneShape{}});
  sph::WoundDescription wound;
  wound.shape = sph::DiscPatch{0.001};
  wound.drive = sph::PressureDriveSettings{pressure, coefficient};
  scene.wounds.push_back(wound);
  auto world = CaseWorld::create(scene, knobs, cost);
  if (!world) return world.status();
  if (Status status = world->runFor(kSeconds); !status.ok()) return status;
  flow = (*world)->wounds().front().flow;
  return (*world)->wounds().front().emitted / kSeconds;
}

}  // namespace

// Bounds: the flow as set follows the law to rounding; the volume that came lacks or exceeds one particle at most.
Result<CaseResult> runOrificeLaw(const Knobs& knobs) {
  CaseResult result;
  const double area = std::numbers::pi * 0.001 * 0.001;
  for (const double mmhg : {10.0, 100.0}) {
    for (const double coefficient : {kLeastCd, kMostCd}) {
      const double pressure = pascalsFromMmHg(mmhg);
      const double law = coefficient * area * std::sqrt(2.0 * pressure / kBloodDensity);
      double flow = 0.0;
      const auto brought = emittedBy(pressure, coefficient, knobs, result.cost, flow);
      if (!brought) return brought.status();
      const std::string suffix = fmt::format("{:.0f}_mmhg_cd_0_{:.0f}", mmhg, 100.0 * coefficient);
      result.figures.push_back(compared("flow_at_" + suffix, 1e6 * flow, 1e6 * law, 1e-6, "mL/s"));
      const double particle = std::pow(spacingOf(knobs), 3.0) / 0.1;  // one of them over the time of the run, m^3/s
      result.figures.push_back(compared("volume_at_" + suffix, 1e6 * *brought, 1e6 * law, 1.01 * particle / law, "mL/s"));
    }
  }
  return result;
}

// A tank, 30 rows deep and 24 wide, empties through a slot in its floor, 6 rows wide; floor and walls are free of friction, sides
// periodic. Cd = (dV/dt)/(A sqrt(2 g H)) with the head H over the slot's upper edge, where a jet that touches nothing below
// leaves (pressure is never below 0, so the floor's thickness sucks nothing), over the time in which the level falls from nine to
// six tenths. Between a sharp edge's pi/(pi + 2) = 0.61 and a rounded one's 0.97. Fewer than 4 particles across resolve nothing.
Result<CaseResult> runOrificeResolved(const Knobs& knobs) {
  const int slot = 2 * ((3 * knobs.across + 10) / 20);  // rows: 6 of 20
  const int width = 4 * slot;
  const int depth = 5 * slot;
  constexpr double kSlot = 0.006;  // m
  const double dx = kSlot / slot;
  const int side = periodicCount(knobs);
  const double thick = 5.0 * dx;
  sph::WorldDescription scene = emptyScene(knobs, dx, 0.3);
  scene.compressibility.max_fall_or_depth = depth * dx + 5.0 * kSlot;
  scene.domain.lower = {-6.0 * dx, 0.0, -4.0 * kSlot};
  scene.domain.upper = {(width + 6.0) * dx, side * dx, (depth + 6.0) * dx};
  scene.domain.periodic = {false, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().viscosity = 0.001;
  scene.effects.gravity.emplace();
  const double left = 0.5 * (width - slot) * dx;
  const auto solid = [&](const char* name, const Vec3& lower, const Vec3& upper) {
    scene.tissue.push_back({.name = name, .shape = sph::BoxShape{.lower = lower, .upper = upper, .obstacle = true}, .slip = 1.0});
  };
  const double beyond = 0.1;  // m: walls reach past the periodic sides
  solid("floor left", {-beyond, -beyond, -thick}, {left, beyond, 0.0});
  solid("floor right", {left + kSlot, -beyond, -thick}, {beyond, beyond, 0.0});
  scene.tissue.push_back(
      {.name = "wall left", .shape = sph::PlaneShape{.point = Vec3::Zero(), .normal = {1, 0, 0}}, .slip = 1.0});
  scene.tissue.push_back(
      {.name = "wall right", .shape = sph::PlaneShape{.point = {width * dx, 0, 0}, .normal = {-1, 0, 0}}, .slip = 1.0});
  addBlock(scene, Vec3::Zero(), {width, side, depth});
  CaseResult result;
  auto world = CaseWorld::create(scene, knobs, result.cost);
  if (!world) return world.status();
  const double full = static_cast<double>(scene.capacity);
  const double area = kSlot * side * dx;
  picture::Series level{"solver", picture::SeriesStyle::line, {}, {}};
  double drained_time = 0.0;  // s, in the measured range
  double potential = 0.0;     // integral of A sqrt(2 g H), m^3
  double first = 0.0;         // particles in the tank at its start and end
  double last = 0.0;
  double before = 0.0;
  const Status status = world->runFor(0.16, [&] {
    const double now = (*world)->time();
    const double step = now - before;
    before = now;
    const Frame frame = world->frame();
    double inside = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) inside += frame.position(i).z() > 0.0 ? 1.0 : 0.0;
    const double part = inside / full;
    level.x.push_back(now);
    level.y.push_back(part);
    if (part > 0.9 || part < 0.6) return;
    if (first == 0.0) first = inside;
    last = inside;
    drained_time += step;
    potential += step * area * std::sqrt(2.0 * kGravity * part * depth * dx);
  });
  if (!status.ok()) return status;
  if (!(drained_time > 0.0)) return Status{StatusCode::internal, "the tank did not empty"};
  const double coefficient = (first - last) * scene.particleVolume() / potential;
  const double middle = 0.5 * (kLeastCd + kMostCd);
  result.figures.push_back(compared("discharge_coefficient", coefficient, middle, kMostCd / middle - 1.0));
  picture::LinePlot plot;
  plot.title = "A tank that empties through a slot";
  plot.x.label = "time, s";
  plot.y.label = "part that is left";
  plot.series.push_back(level);
  for (const double cd : {kLeastCd, kMostCd}) {
    picture::Series law{fmt::format("Cd = {}", cd), picture::SeriesStyle::line, {}, {}};
    double part = 1.0;
    for (std::size_t k = 0; k < level.x.size(); ++k) {
      const double step = level.x[k] - (k == 0 ? 0.0 : level.x[k - 1]);
      part -= step * cd * area * std::sqrt(2.0 * kGravity * part * depth * dx) / (full * scene.particleVolume());
      law.x.push_back(level.x[k]);
      law.y.push_back(part);
    }
    plot.series.push_back(law);
  }
  result.plots.push_back({"orifice_resolved", plot});
  return result;
}

}  // namespace bleedsim::lab
