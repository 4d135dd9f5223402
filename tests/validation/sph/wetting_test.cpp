// Blood against tissue: the contact angle of a sessile drop, and a film that adhesion holds under a ceiling. dx 1 mm.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "tests/stability/sph/measure.h"
#include "tests/support/drops.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

/// Mean height of the cap of a sphere that meets the plane at `angle` (rad) and has `volume` (m^3):
/// V = pi R^3 (2 - 3 c + c^3)/3, height H = R (1 - c), mean height H (4 R - H)/(4 (3 R - H)), c = cos(angle).
double capMeanHeight(double angle, double volume) {
  const double c = std::cos(angle);
  const double radius = std::cbrt(3.0 * volume / (std::numbers::pi * (2.0 - 3.0 * c + c * c * c)));
  const double height = radius * (1.0 - c);
  return height * (4.0 * radius - height) / (4.0 * (3.0 * radius - height));
}

/// A half ball of R = 7 dx on the plane z = 0 without gravity, after 0.4 s at 0.05 Pa s.
std::unique_ptr<sph::World> sessileDrop(double support_ratio, double angle) {
  sph::WorldDescription scene = emptyScene();
  scene.support_ratio = support_ratio;
  scene.domain.lower = {-0.03, -0.03, -0.005};
  scene.domain.upper = Vec3::Constant(0.03);
  scene.compressibility.design_speed = 0.3;
  scene.tissue.push_back({.name = "plane", .shape = sph::PlaneShape{}});
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.viscosity->viscosity = 0.05;
  scene.effects.surface_tension.emplace();
  scene.effects.surface_tension->contact_angle = angle;
  addBall(scene, Vec3::Zero(), 0.007, [](const Vec3& x) { return x.z() > 0.0; });
  auto world = makeWorld(scene);
  runFor(*world, 0.4);
  return world;
}

class WettingTest : public testing::TestWithParam<double> {};

// Without gravity a drop at rest is a cap that meets the plane at the contact angle. Its mean height says which: 30, 90 and 150
// degrees spread, stand and bead. Measured: 1.06, 0.92 and 0.81 of the cap's at h = 2.5 dx, 1.10, 0.89 and 0.81 at 3 dx, which
// are caps of 33, 83 and 128 and of 34, 80 and 128 degrees: the layer within h of the plane, where the normal turns to the angle,
// is a third to half of the drop, and in a beaded drop the overhang next to the plane is thinner than h. The ratio of
// mean height to mean radius says the same to 2 degrees, but in the drop that beads at 3 dx, where strays move it by 9.
TEST_P(WettingTest, aDropSpreadsOrBeadsByTheContactAngle) {
  double before = 0.0;
  for (const auto& [degrees, bound] : {std::pair{30.0, 0.12}, std::pair{90.0, 0.13}, std::pair{150.0, 0.20}}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const auto world = sessileDrop(GetParam(), angle);
    const double height = statsOf(*world).center.z();
    const double expected = capMeanHeight(angle, world->particleCount() * world->description().particleVolume());
    RecordProperty("height_ratio_at_" + std::to_string(static_cast<int>(degrees)), std::to_string(height / expected));
    EXPECT_NEAR(height / expected, 1.0, bound) << degrees << " degrees";
    EXPECT_GT(height, 1.2 * before);
    expectInvariants(*world);
    before = height;
  }
}

INSTANTIATE_TEST_SUITE_P(supportRatios, WettingTest, testing::Values(2.5, 3.0),
                         [](const auto& tested) { return tested.param == 2.5 ? "twoAndAHalf" : "three"; });

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
