#include "service/lab/validation/channel.h"

namespace bleedsim::lab {

sph::WorldDescription channelScene(const Knobs& knobs, int rows, double depth, bool lid, const sph::Vec3& force,
                                   double design_speed) {
  const double dx = depth / rows;
  const int side = periodicCount(knobs);
  sph::WorldDescription scene = emptyScene(knobs, dx, design_speed);
  scene.domain.lower = {0, 0, -4.0 * dx};
  scene.domain.upper = {side * dx, side * dx, depth + 4.0 * dx};
  scene.domain.periodic = {true, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().solve = sph::ViscositySolve::explicit_;
  scene.effects.gravity.emplace().acceleration = force;
  scene.tissue.push_back({.name = "floor", .shape = sph::PlaneShape{}});
  if (lid) scene.tissue.push_back({.name = "lid", .shape = sph::PlaneShape{.point = {0, 0, depth}, .normal = {0, 0, -1}}});
  addBlock(scene, sph::Vec3::Zero(), {side, side, rows});
  return scene;
}

std::vector<double> rowSpeeds(const sph::World& world, int rows) {
  const Frame frame = frameOf(world);
  std::vector<double> speeds;
  for (int row = 0; row < rows; ++row) {
    speeds.push_back(layerMean(frame, world.description().spacing, 2, row, [&](std::size_t i) { return frame.velocity(i).x(); }));
  }
  return speeds;
}

double profileError(const std::vector<double>& speeds, double spacing, const Profile& exact) {
  RelativeL2 error;
  for (std::size_t row = 0; row < speeds.size(); ++row) error.add(speeds[row], exact((static_cast<double>(row) + 0.5) * spacing));
  return error.value();
}

void addProfile(picture::LinePlot& plot, const std::string& name, const std::vector<double>& speeds, double spacing,
                const Profile& exact) {
  constexpr int kNodes = 100;
  picture::Series line{name + ", reference", picture::SeriesStyle::line, {}, {}};
  const double depth = spacing * static_cast<double>(speeds.size());
  for (int k = 0; k <= kNodes; ++k) {
    line.x.push_back(depth * k / kNodes);
    line.y.push_back(exact(line.x.back()));
  }
  picture::Series points{name, picture::SeriesStyle::points, {}, speeds};
  for (std::size_t row = 0; row < speeds.size(); ++row) points.x.push_back((static_cast<double>(row) + 0.5) * spacing);
  plot.series.push_back(line);
  plot.series.push_back(points);
}

}  // namespace bleedsim::lab
