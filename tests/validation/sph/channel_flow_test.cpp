// Flow between and over walls, driven by a body force: physics.md section 5, cases 5, 6 (the layers) and 13. Couette flow itself
// needs a moving wall, which the solver does not have.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

#include "tests/validation/sph/channel.h"

namespace bleedsim::test {
namespace {

class ChannelTest : public testing::TestWithParam<double> {
 protected:
  static bool isWide() { return GetParam() > 2.0; }  ///< h = 2.5 dx instead of 2 dx
};

// Morris, Fox & Zhu 1997: L = 1 mm, nu = 1e-6 m^2/s, F = 1e-4 m/s^2, 20 across.
// u = F/(2 nu) z (L - z) - sum_n 4 F L^2/(nu pi^3 (2n+1)^3) sin(pi z (2n+1)/L) exp(-(2n+1)^2 pi^2 nu t/L^2). Reached at h = 2
// / 2.5 dx, the same on every target and in double: 0.73 / 0.88, 0.50 / 0.60, 0.37 / 0.44, 0.34 / 0.38 % at Morris's times and
// 0.32 / 0.33 % steady, as walls.md has it. Allowed are 1.5 times the larger; physics.md asks for 3 / 1 %.
TEST_P(ChannelTest, poiseuille) {
  constexpr double kLength = 0.001;
  constexpr double kNu = 1e-6;
  constexpr double kForce = 1e-4;
  sph::WorldDescription scene = channel(20, kLength, GetParam(), true, {kForce, 0, 0});
  scene.compressibility.design_speed = 1.25e-5;
  scene.effects.viscosity->viscosity = kNu * kRestDensity;
  scene.effects.viscosity->solve = sph::ViscositySolve::explicit_;  // the form whose figures walls.md gives
  const auto world = makeWorld(scene);
  const auto exact = [&](double z) {
    const double pi = std::numbers::pi;
    double speed = kForce / (2.0 * kNu) * z * (kLength - z);
    for (int n = 0; n < 30; ++n) {
      const double k = 2.0 * n + 1.0;
      speed -= 4.0 * kForce * kLength * kLength / (kNu * pi * pi * pi * k * k * k) * std::sin(pi * z * k / kLength) *
               std::exp(-k * k * pi * pi * kNu * world->time() / (kLength * kLength));
    }
    return speed;
  };
  constexpr std::array<std::pair<double, double>, 5> kAllowed{
      {{0.0225, 0.0132}, {0.045, 0.009}, {0.1125, 0.0066}, {0.225, 0.0057}, {0.7, 0.005}}};
  for (const auto& [time, allowed] : kAllowed) {
    runFor(*world, time - world->time());
    const double error = profileError(*world, 20, exact);
    RecordProperty("l2_at_" + std::to_string(time), std::to_string(error));
    EXPECT_LT(error, allowed) << "t = " << time << " s";
  }
}

// Two layers, mu 1:10, under one body force: the stress rho F (z* - z) is continuous, so with a = L/2
//   lower: u = F/nu1 (z* z - z^2/2)     upper: u = F/nu2 ((L^2 - z^2)/2 - z* (L - z))
//   equal at a: z* = (a^2/(2 nu1) + (L^2 - a^2)/(2 nu2)) / (a/nu1 + (L - a)/nu2)
// The harmonic mean makes the stress between the layers exact (physics.md section 1). 12 across, so 6 rows a layer: reached
// are 2.3 / 2.5 %, L2 <= 3 %.
TEST_P(ChannelTest, twoLayers) {
  constexpr double kLength = 0.001;
  constexpr double kForce = 1e-4;
  constexpr double kNuLower = 1e-6;
  constexpr double kNuUpper = 1e-5;
  constexpr int kRows = 12;
  sph::WorldDescription scene = channel(kRows, kLength, GetParam(), true, {kForce, 0, 0});
  scene.compressibility.design_speed = 1.25e-5;
  scene.effects.viscosity->viscosity = kNuLower * kRestDensity;
  scene.effects.viscosity->solve = sph::ViscositySolve::explicit_;  // the form with the exact harmonic mean
  scene.fluid_blocks.clear();
  addBlock(scene, sph::Vec3::Zero(), {8, 8, kRows / 2});
  addBlock(scene, {0, 0, 0.5 * kLength}, {8, 8, kRows / 2});
  scene.fluid_blocks.back().viscosity = kNuUpper * kRestDensity;
  const auto world = makeWorld(scene);
  runFor(*world, 0.8);
  const double a = 0.5 * kLength;
  const double turn =
      (a * a / (2.0 * kNuLower) + (kLength * kLength - a * a) / (2.0 * kNuUpper)) / (a / kNuLower + (kLength - a) / kNuUpper);
  const double error = profileError(*world, kRows, [&](double z) {
    if (z < a) return kForce / kNuLower * (turn * z - 0.5 * z * z);
    return kForce / kNuUpper * (0.5 * (kLength * kLength - z * z) - turn * (kLength - z));
  });
  RecordProperty("l2", std::to_string(error));
  EXPECT_LT(error, 0.03);
}

// A film on a slope of 30 degrees, H = 3 mm, mu = 0.1 Pa s: u_s = rho g sin(30) H^2/(2 mu) = 0.234 m/s, q = u_s H 2/3 = 4.68e-4
// m^2/s. 10 across. Reached at h = 2 / 2.5 dx: -0.6 / -0.9 % in the speed of the surface row, whose middle is half a spacing
// below the surface (walls.md: -0.8 / -2.7 %), and -3.5 / -1.7 % in q. Allowed are 1.5 times that; physics.md asks for 8 / 4 %.
TEST_P(ChannelTest, incline) {
  constexpr double kDepth = 0.003;
  constexpr int kRows = 10;
  const double angle = std::numbers::pi / 6.0;
  sph::WorldDescription scene =
      channel(kRows, kDepth, GetParam(), false, kGravity * sph::Vec3{std::sin(angle), 0, -std::cos(angle)});
  scene.effects.viscosity->viscosity = 0.1;
  scene.compressibility.design_speed = 0.234;
  scene.compressibility.max_fall_or_depth = kDepth;
  const auto world = makeWorld(scene);
  runFor(*world, 0.25);
  const double surface = kRestDensity * kGravity * std::sin(angle) * kDepth * kDepth / (2.0 * 0.1);
  const double z = kDepth - 0.5 * world->description().spacing;
  const double at_row = surface * (1.0 - (1.0 - z / kDepth) * (1.0 - z / kDepth));
  const double ratio = statsOf(*world).max_speed / at_row;
  const sph::WorldStats stats = statsOf(*world);
  const double flow = stats.momentum.x() / (kRestDensity * std::pow(8.0 * world->description().spacing, 2));
  RecordProperty("surface_ratio", std::to_string(ratio));
  RecordProperty("flow_ratio", std::to_string(flow / (surface * kDepth * 2.0 / 3.0)));
  EXPECT_NEAR(ratio, 1.0, isWide() ? 0.0135 : 0.0096);
  EXPECT_NEAR(flow / (surface * kDepth * 2.0 / 3.0), 1.0, isWide() ? 0.0255 : 0.0525);
  expectInvariants(*world);
}

INSTANTIATE_TEST_SUITE_P(supportRatios, ChannelTest, testing::Values(2.0, 2.5),
                         [](const auto& tested) { return tested.param == 2.0 ? "two" : "twoAndAHalf"; });

}  // namespace
}  // namespace bleedsim::test
