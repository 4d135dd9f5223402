// Case 14, the puddle, and the contact angle without gravity: blood that meets tissue at an angle.
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

using sph::Vec3;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Mean height of the cap of a sphere that meets the plane at `angle` (rad) and has `volume` (m^3):
/// V = pi R^3 (2 - 3 c + c^3)/3, height H = R (1 - c), mean height H (4 R - H)/(4 (3 R - H)), c = cos(angle).
double capMeanHeight(double angle, double volume) {
  const double c = std::cos(angle);
  const double radius = std::cbrt(3.0 * volume / (std::numbers::pi * (2.0 - 3.0 * c + c * c * c)));
  const double height = radius * (1.0 - c);
  return height * (4.0 * radius - height) / (4.0 * (3.0 * radius - height));
}

/// The angle of the cap that has this mean height, degrees; it rises with the angle.
double capAngle(double mean_height, double volume) {
  double low = 1.0;
  double high = 179.0;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    (capMeanHeight(middle * kDegree, volume) < mean_height ? low : high) = middle;
  }
  return low;
}

void addWettingFluid(sph::WorldDescription& scene, double angle) {
  scene.tissue.push_back({.name = "plane", .shape = sph::PlaneShape{}});
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().viscosity = 0.05;
  scene.effects.surface_tension.emplace().contact_angle = angle;
}

}  // namespace

// A ridge of blood, ten capillary lengths wide, periodic along y; its middle is flat and as high as a wide puddle. Twice the mean
// height of the particles near the middle is the height there.
Result<CaseResult> runPuddle(const Knobs& knobs) {
  CaseResult result;
  picture::LinePlot plot;
  plot.title = "Profile of a ridge of blood";
  plot.x.label = "x, m";
  plot.y.label = "height, m";
  for (const double degrees : {90.0, 60.0}) {
    if (degrees < 90.0 && !knobs.beside) continue;
    sph::WorldDescription scene = emptyScene(knobs, 0.0, 0.15);
    const double capillary = std::sqrt(0.0526 / (kBloodDensity * kGravity));
    const double expected = 2.0 * capillary * std::sin(0.5 * degrees * kDegree);
    const int rows = std::max(4, 2 * knobs.across / 5);  // 8 of 20: a row more or less is the accuracy that can be expected
    scene.spacing = expected / rows;
    const double dx = scene.spacing;
    const int side = periodicCount(knobs);
    const int wide = static_cast<int>(std::lround(10.0 * capillary / dx));
    scene.compressibility.max_fall_or_depth = expected;
    scene.domain.lower = {-12.0 * capillary, 0.0, -6.0 * dx};
    scene.domain.upper = {12.0 * capillary, side * dx, 3.0 * expected};
    scene.domain.periodic = {false, true, false};
    addWettingFluid(scene, degrees * kDegree);
    scene.effects.gravity.emplace();
    addBlock(scene, {-0.5 * wide * dx, 0.0, 0.0}, {wide, side, rows + 2});
    auto world = CaseWorld::create(scene, knobs, result.cost);
    if (!world) return world.status();
    if (Status status = world->runFor(0.25); !status.ok()) return status;
    const Frame frame = world->frame();
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (std::abs(frame.position(i).x()) > 1.5 * capillary) continue;
      sum += frame.position(i).z();
      ++count;
    }
    result.figures.push_back(
        compared(fmt::format("height_at_{:.0f}_degrees", degrees), 2e3 * sum / count, 1e3 * expected, std::nullopt, "mm"));
    picture::Series points{fmt::format("{:.0f} degrees", degrees), picture::SeriesStyle::points, {}, {}};
    for (int column = -2 * wide; column < 2 * wide; ++column) {
      const double height = layerMean(frame, dx, 0, column, [&](std::size_t i) { return 2.0 * frame.position(i).z(); });
      if (!std::isfinite(height)) continue;
      points.x.push_back((column + 0.5) * dx);
      points.y.push_back(height);
    }
    plot.series.push_back(points);
    plot.lines.push_back(
        {picture::ReferenceLine::Direction::horizontal, expected, fmt::format("2 l_c sin({:.0f} degrees)", degrees / 2.0)});
  }
  result.plots.push_back({"puddle", plot});
  return result;
}

// A half ball of R = 7 dx on the plane, without gravity, after 0.4 s: a drop at rest is a cap that meets the plane at the contact
// angle, and its mean height says which.
Result<CaseResult> runContactAngle(const Knobs& knobs) {
  CaseResult result;
  for (const double degrees : {30.0, 90.0, 150.0}) {
    constexpr double kRadius = 0.007;  // m
    sph::WorldDescription scene = emptyScene(knobs, 2.0 * kRadius * 10.0 / (7.0 * knobs.across), 0.3);
    scene.domain.lower = {-0.03, -0.03, -0.005};
    scene.domain.upper = Vec3::Constant(0.03);
    addWettingFluid(scene, degrees * kDegree);
    addBall(scene, kRadius, [](const Vec3& x) { return x.z() > 0.0; });
    auto world = CaseWorld::create(scene, knobs, result.cost);
    if (!world) return world.status();
    if (Status status = world->runFor(0.4); !status.ok()) return status;
    const double height = world->stats().center.z();
    const double volume = (*world)->particleCount() * scene.particleVolume();
    result.figures.push_back(compared(fmt::format("height_at_{:.0f}_degrees", degrees), 1e3 * height,
                                      1e3 * capMeanHeight(degrees * kDegree, volume), std::nullopt, "mm"));
    result.figures.push_back(
        compared(fmt::format("angle_at_{:.0f}_degrees", degrees), capAngle(height, volume), degrees, std::nullopt, "degrees"));
  }
  return result;
}

}  // namespace bleedsim::lab
