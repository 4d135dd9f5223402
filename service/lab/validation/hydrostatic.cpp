// Case 4: p = rho g (H - z) in a column on a floor, periodic sides, 20 mm deep, mu 0.05 Pa s.
#include <cmath>
#include <fmt/core.h>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

constexpr double kDepth = 0.02;  // m

sph::WorldDescription column(const Knobs& knobs) {
  const double dx = kDepth / knobs.across;
  const int side = periodicCount(knobs);
  sph::WorldDescription scene = emptyScene(knobs, dx, 0.5);
  scene.compressibility.max_fall_or_depth = kDepth;
  scene.tissue.push_back({.name = "floor", .shape = sph::PlaneShape{}});
  scene.domain.lower = {0, 0, -10.0 * dx};
  scene.domain.upper = {side * dx, side * dx, 2.0 * kDepth};
  scene.domain.periodic = {true, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().viscosity = 0.05;
  scene.effects.gravity.emplace();
  addBlock(scene, sph::Vec3::Zero(), {side, side, knobs.across});
  return scene;
}

/// Least squares of pressure against height.
class Line {
 public:
  void add(double x, double y) {
    count_ += 1.0;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }
  double slope() const { return (count_ * xy_ - x_ * y_) / (count_ * xx_ - x_ * x_); }

 private:
  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

struct Rest {
  double slope = 0.0;        ///< -dp/dz over rho g, at least 3 dx from floor and surface
  double speed = 0.0;        ///< root mean square, over sqrt(g H)
  double compression = 0.0;  ///< largest
  double mean_compression = 0.0;
};
/// After 0.2 s, over 20 x 4 times what sound takes through the column. The start is a cold lattice: it first rings.
Result<Rest> atRest(const sph::WorldDescription& scene, const Knobs& knobs, RunCost& cost, picture::Series& profile) {
  auto world = CaseWorld::create(scene, knobs, cost);
  if (!world) return world.status();
  if (Status status = world->runFor(0.2); !status.ok()) return status;
  const double c2 = (*world)->speedOfSound() * (*world)->speedOfSound();
  const bool clamped = scene.model == sph::Model::sound;
  Line line;
  const Status status = world->runFor(80.0 * kDepth / (*world)->speedOfSound(), [&] {
    if ((*world)->stepCount() % 25 != 0) return;
    const Frame frame = world->frame();
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const double z = frame.position(i).z();
      if (z < 3.0 * scene.spacing || z > kDepth - 3.0 * scene.spacing) continue;
      const double pressure = c2 * (frame.density(i) - kBloodDensity);
      line.add(z, clamped ? std::max(0.0, pressure) : pressure);
    }
  });
  if (!status.ok()) return status;
  const Frame frame = world->frame();
  const int rows = static_cast<int>(std::lround(kDepth / scene.spacing));
  for (int row = 0; row < rows; ++row) {
    profile.x.push_back((row + 0.5) * scene.spacing);
    profile.y.push_back(layerMean(frame, scene.spacing, 2, row, [&](std::size_t i) {
      const double pressure = c2 * (frame.density(i) - kBloodDensity);
      return clamped ? std::max(0.0, pressure) : pressure;
    }));
  }
  const sph::WorldStats stats = world->stats();
  const double speed = std::sqrt(2.0 * stats.kinetic_energy / ((*world)->particleMass() * stats.particles));
  return Rest{-line.slope() / (kBloodDensity * kGravity), speed / std::sqrt(kGravity * kDepth), stats.max_density_error,
              stats.mean_density_error};
}

}  // namespace

Result<CaseResult> runHydrostatic(const Knobs& knobs) {
  CaseResult result;
  const sph::WorldDescription scene = column(knobs);
  picture::LinePlot plot;
  plot.title = "Pressure of a column at rest";
  plot.x.label = "height, m";
  plot.y.label = "pressure, Pa";
  picture::Series exact{"rho g (H - z)", picture::SeriesStyle::line, {0.0, kDepth}, {kBloodDensity * kGravity * kDepth, 0.0}};
  picture::Series found{"sound", picture::SeriesStyle::points, {}, {}};
  const auto rest = atRest(scene, knobs, result.cost, found);
  if (!rest) return rest.status();
  result.figures.push_back(compared("pressure_slope", rest->slope, 1.0, knobs.bound(0.07, 0.02)));
  result.figures.push_back(residual("speed_over_sqrt_gh", rest->speed, 0.03));
  result.figures.push_back(residual("compression", rest->compression, 1.5 / (knobs.mach_factor * knobs.mach_factor)));
  result.figures.push_back(residual("mean_compression", rest->mean_compression, std::nullopt));
  plot.series = {exact, found};
  if (knobs.beside && knobs.precision == sph::Precision::float32) {
    sph::WorldDescription literal = scene;
    literal.model = sph::Model::literal;
    RunCost aside;
    picture::Series printed{"literal", picture::SeriesStyle::points, {}, {}};
    const auto other = atRest(literal, knobs, aside, printed);
    if (other) {
      result.figures.push_back(compared("literal_pressure_slope", other->slope, 1.0, std::nullopt));
      result.figures.push_back(residual("literal_speed_over_sqrt_gh", other->speed, std::nullopt));
      plot.series.push_back(printed);
    } else {
      result.notes.push_back("literal: " + other.status().message());
    }
  }
  result.plots.push_back({"hydrostatic", plot});
  return result;
}

}  // namespace bleedsim::lab
