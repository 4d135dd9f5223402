// A film that adhesion holds under a ceiling. dx 1 mm. Contact angles are the case contact_angle (cases_test.cpp).
#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

/// Height of the highest and lowest particle of a film of two layers after 0.1 s under the ceiling z = 0.
std::array<double, 2> hungFilm(bool adhesion) {
  sph::WorldDescription scene = freeBlock({12, 12, 2});
  scene.fluid_blocks.front().lower.z() = -0.002;
  scene.fluid_blocks.front().upper.z() = 0.0;
  scene.domain.lower = {-0.006, -0.006, -0.09};
  scene.domain.upper = {0.006, 0.006, 0.01};
  scene.domain.periodic = {true, true, false};
  scene.tissue.push_back({.name = "ceiling", .shape = sph::PlaneShape{.point = Vec3::Zero(), .normal = {0.0, 0.0, -1.0}}});
  scene.effects.gravity.emplace();
  scene.effects.surface_tension.emplace();
  if (adhesion) scene.effects.adhesion = sph::AdhesionSettings{30.0};
  const auto world = makeWorld(scene);
  runFor(*world, 0.1);
  expectInvariants(*world);
  const sph::FrameBuffer frame = frameOf(*world);
  std::array<double, 2> ends{-1.0, 1.0};
  for (std::size_t i = 0; i < frame.count; ++i) {
    ends[0] = std::max(ends[0], positionOf(frame, i).z());
    ends[1] = std::min(ends[1], positionOf(frame, i).z());
  }
  return ends;
}

// Weight pulls both layers with 9.81 m/s^2, adhesion of 30 m/s^2 the upper one with 30 and the lower one, d = 1.5 dx, with 15: it
// holds them. Without adhesion the film falls freely, g t^2/2 = 49 mm, but for the little that tissue's pressure adds.
TEST(AdhesionTest, aFilmHangsByAdhesionAndFallsWithoutIt) {
  const std::array<double, 2> held = hungFilm(true);
  EXPECT_GT(held[1], -0.003);
  const std::array<double, 2> fallen = hungFilm(false);
  EXPECT_LT(fallen[0], -0.04);
}

}  // namespace
}  // namespace bleedsim::test
