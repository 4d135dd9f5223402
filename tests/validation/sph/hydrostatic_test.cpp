// Pressure of a column at rest: p = rho g (H - z), so dp/dz = -rho g. physics.md section 5 case 4.
#include <cmath>
#include <gtest/gtest.h>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

class HydrostaticTest : public testing::TestWithParam<double> {};

// The slope over the particles at least 3 dx from floor and surface, over rho g. 20 dx deep on a floor, periodic sides, mu 0.05
// Pa s. Reached at h = 2 / 2.5 dx: 1.046..1.048 / 1.011..1.014 by target and precision (walls.md: 1.057 / 0.993; every quiet wall
// reads +3..6 % at h = 2 dx). Allowed are physics.md's 7 % / 1.5 times what was reached. Root mean square speed over sqrt(gH):
// reached 0.0080 / 0.0040 (walls.md: 0.0018 / 0.0039 in a box); allowed are physics.md's 0.01 / 1.5 times what was reached.
TEST_P(HydrostaticTest, pressureSlope) {
  sph::WorldDescription scene = hydrostaticColumn({8, 8, 20}, 0.05);
  scene.support_ratio = GetParam();
  scene.tissue.front().shape = sph::PlaneShape{};
  scene.domain.lower = {0, 0, -0.01};
  scene.domain.upper = {0.008, 0.008, 0.04};
  scene.domain.periodic = {true, true, false};
  const auto world = makeWorld(scene);
  runFor(*world, 0.2);
  const double height = 0.02;
  const double c2 = world->speedOfSound() * world->speedOfSound();
  double count = 0.0, z_sum = 0.0, p_sum = 0.0, zz_sum = 0.0, zp_sum = 0.0;
  runFor(*world, 20.0 * 4.0 * height / world->speedOfSound(), [&] {
    if (world->stepCount() % 25 != 0) return;
    const sph::FrameBuffer frame = frameOf(*world);
    for (std::size_t i = 0; i < frame.count; ++i) {
      const double z = positionOf(frame, i).z();
      if (z < 3.0 * kSpacing || z > height - 3.0 * kSpacing) continue;
      const double pressure = std::max(0.0, c2 * (static_cast<double>(frame.density[i]) - kRestDensity));
      count += 1.0;
      z_sum += z;
      p_sum += pressure;
      zz_sum += z * z;
      zp_sum += z * pressure;
    }
  });
  ASSERT_GT(count, 500.0);
  const double slope = (count * zp_sum - z_sum * p_sum) / (count * zz_sum - z_sum * z_sum);
  const double ratio = -slope / (kRestDensity * kGravity);
  RecordProperty("slope_ratio", std::to_string(ratio));
  EXPECT_NEAR(ratio, 1.0, GetParam() > 2.0 ? 0.019 : 0.07);
  const double speed = speedRms(*world) / std::sqrt(kGravity * height);
  RecordProperty("speed_ratio", std::to_string(speed));
  EXPECT_LT(speed, GetParam() > 2.0 ? 0.0061 : 0.01);
}

INSTANTIATE_TEST_SUITE_P(supportRatios, HydrostaticTest, testing::Values(2.0, 2.5),
                         [](const auto& tested) { return tested.param == 2.0 ? "two" : "twoAndAHalf"; });

}  // namespace
}  // namespace bleedsim::test
