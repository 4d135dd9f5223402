// Blood at rest stays at rest: physics.md section 5 (case 4), walls.md "column 20 dx".
#include <cmath>
#include <gtest/gtest.h>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

class RestTest : public testing::TestWithParam<double> {};

// v_rms < 0.01 sqrt(gH), and the compression of the floor row, gH/c0^2 = 1/(2 mach^2) for c0 = mach sqrt(2gH), within
// the 1.5/mach^2 that physics.md allows. The start is a cold lattice, so the column first rings; 0.4 s are about 120 sound
// crossings.
TEST_P(RestTest, hydrostaticBox) {
  sph::WorldDescription scene = hydrostaticColumn({10, 10, 20}, 0.05);
  scene.support_ratio = GetParam();
  const auto world = makeWorld(scene);
  runFor(*world, 0.4);
  const double height = 20 * kSpacing;
  const double speed = speedRms(*world) / std::sqrt(kGravity * height);
  const sph::WorldStats stats = statsOf(*world);
  RecordProperty("v_rms_over_sqrt_gH", std::to_string(speed));
  RecordProperty("max_compression", std::to_string(stats.max_density_error));
  EXPECT_LT(speed, 0.01);
  EXPECT_LT(stats.max_density_error, 1.5 / (10.0 * 10.0));
  // Top within 5 %: half the compression of the floor row would be 0.25 %, settling of the lattice takes the rest.
  EXPECT_NEAR(stats.center.z() / (0.5 * height), 1.0, 0.05);
  expectInvariants(*world);
  EXPECT_EQ(counterOf(*world, sph::Counter::tissue_projected), 0u);
}

// Without gravity and walls nothing drives the rest lattice but the rounding of float, which must not add up.
TEST_P(RestTest, freeLatticeDoesNotDrift) {
  sph::WorldDescription scene = freeBlock({12, 12, 12});
  scene.support_ratio = GetParam();
  const auto world = makeWorld(scene);
  const sph::FrameBuffer before = frameOf(*world);
  runFor(*world, 1.0);
  const sph::FrameBuffer after = frameOf(*world);
  ASSERT_EQ(before.count, after.count);
  double furthest = 0.0;
  for (std::size_t i = 0; i < before.count; ++i) {
    for (std::size_t j = 0; j < after.count; ++j) {
      if (after.id[j] != before.id[i]) continue;
      furthest = std::max(furthest, (positionOf(after, j) - positionOf(before, i)).norm());
    }
  }
  EXPECT_LT(furthest, 0.01 * kSpacing);
}

INSTANTIATE_TEST_SUITE_P(supportRatios, RestTest, testing::Values(2.0, 2.5),
                         [](const auto& tested) { return tested.param == 2.0 ? "two" : "twoAndAHalf"; });

}  // namespace
}  // namespace bleedsim::test
