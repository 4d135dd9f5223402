// Blood between or over plane walls, and its velocity profile.
#pragma once

#include <cmath>
#include <functional>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {

/// Blood `rows` spacings deep on the plane z = 0, periodic along x and y, under the acceleration `force`. With a lid also
/// between.
inline sph::WorldDescription channel(int rows, double depth, double support_ratio, bool lid, const sph::Vec3& force) {
  sph::WorldDescription scene = emptyScene();
  const double dx = depth / rows;
  const double side = 8.0 * dx;
  scene.spacing = dx;
  scene.support_ratio = support_ratio;
  scene.domain.lower = {0, 0, -4.0 * dx};
  scene.domain.upper = {side, side, depth + 4.0 * dx};
  scene.domain.periodic = {true, true, false};
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.gravity.emplace().acceleration = force;
  scene.tissue.push_back({.name = "floor", .shape = sph::PlaneShape{}});
  if (lid) scene.tissue.push_back({.name = "lid", .shape = sph::PlaneShape{.point = {0, 0, depth}, .normal = {0, 0, -1}}});
  addBlock(scene, sph::Vec3::Zero(), {8, 8, rows});
  return scene;
}

/// L2 of the rows' mean u_x against `exact(z)` at their middles, relative to that of `exact`.
inline double profileError(const sph::World& world, int rows, const std::function<double(double)>& exact) {
  const sph::FrameBuffer frame = frameOf(world);
  double squares = 0.0;
  double reference = 0.0;
  for (int row = 0; row < rows; ++row) {
    const double found = layerMean(world, frame, 2, 0.0, row, [&](std::size_t i) { return velocityOf(frame, i).x(); });
    const double wanted = exact((row + 0.5) * world.description().spacing);
    squares += (found - wanted) * (found - wanted);
    reference += wanted * wanted;
  }
  return std::sqrt(squares / reference);
}

}  // namespace bleedsim::test
