#include "service/sph/tissue/share_table.h"

#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

class ShareTableTest : public testing::TestWithParam<double> {
 protected:
  ShareSettings settings_ = settingsFor(GetParam());
  double h_ = settings_.kernel.h;
};

// What the layers mean, summed without their closed forms: lattice points behind the plane, averaged over lateral offsets.
TEST_P(ShareTableTest, isTheAverageOverLateralOffsetsOfTheLattice) {
  const double volume = settings_.particle_mass / settings_.rest_density;
  const int reach = static_cast<int>(GetParam()) + 2;
  const int offsets = 12;
  for (const double d : {-0.4 * kSpacing, 0.5 * kSpacing, 0.8 * kSpacing, 1.3 * kSpacing}) {
    Share<double> sum;
    for (int a = 0; a < offsets; ++a) {
      for (int b = 0; b < offsets; ++b) {
        for (int layer = 0; layer < 2 * reach; ++layer) {
          for (int i = -reach; i <= reach; ++i) {
            for (int j = -reach; j <= reach; ++j) {
              const double x = (i + static_cast<double>(a) / offsets) * kSpacing;
              const double y = (j + static_cast<double>(b) / offsets) * kSpacing;
              const double depth = (layer + 0.5) * kSpacing;
              const double r = vectorLength(x, y, d + depth);
              const double f = 2.0 * settings_.kernel.slope(r) * r / (r * r + 0.01 * h_ * h_);
              const double weight = volume / (offsets * offsets);
              sum.share += weight * settings_.kernel.value(r);
              sum.friction += weight * f;
              sum.friction_depth += weight * f * depth;
            }
          }
        }
      }
    }
    const Share<double> plane = planeShare(settings_, d);
    EXPECT_NEAR(plane.share, sum.share, 2e-4 * sum.share) << d;
    EXPECT_NEAR(plane.friction / sum.friction, 1.0, 5e-3) << d;
    EXPECT_NEAR(plane.friction_depth / sum.friction_depth, 1.0, 5e-3) << d;
  }
}

TEST_P(ShareTableTest, slopeIsTheDerivativeOfTheShare) {
  const double step = 1e-4 * kSpacing;
  for (int k = -19; k < 20; ++k) {
    const double d = 0.0497 * k * h_;
    const double slope = (planeShare(settings_, d + step).share - planeShare(settings_, d - step).share) / (2.0 * step);
    EXPECT_NEAR(planeShare(settings_, d).slope, slope, 1e-6 / kSpacing) << d;
  }
}

TEST_P(ShareTableTest, tableFollowsTheSumsBetweenItsNodes) {
  const ShareTable<double> table{settings_, 0.0};
  const ShareTable<float> single{settings_, 0.0};
  for (int k = -300; k <= 300; ++k) {
    const double d = k * h_ / 300.5;
    const Share<double> exact = planeShare(settings_, d);
    const Share<double> read = table.at(d);
    EXPECT_NEAR(read.share, exact.share, 1e-5);
    EXPECT_NEAR(read.slope * kSpacing, exact.slope * kSpacing, 2e-5);
    EXPECT_NEAR(read.friction * kSpacing * kSpacing, exact.friction * kSpacing * kSpacing, 2e-3);
    EXPECT_NEAR(read.friction_depth * kSpacing, exact.friction_depth * kSpacing, 2e-3);
    const Share<float> read_single = single.at(static_cast<float>(d));
    EXPECT_NEAR(static_cast<double>(read_single.share), read.share, 2e-6);
    EXPECT_NEAR(static_cast<double>(read_single.slope) * kSpacing, read.slope * kSpacing, 2e-5);
  }
}

TEST_P(ShareTableTest, staysInRangeAndEndsAtTheSupport) {
  for (const double curvature : {0.0, 1.0 / (6.0 * kSpacing), -1.0 / (6.0 * kSpacing)}) {
    const ShareTable<double> table{settings_, curvature};
    for (int k = -1200; k <= 1200; ++k) {
      const Share<double> share = table.at(k * h_ / 1000.0);
      EXPECT_GE(share.share, 0.0);
      EXPECT_LE(share.share, 1.0);
      EXPECT_LE(share.friction, 0.0);
      EXPECT_LE(share.friction_depth, 0.0);
      EXPECT_TRUE(std::isfinite(share.slope));
    }
    EXPECT_NEAR(table.at(h_).share, 0.0, 1e-12);
    EXPECT_NEAR(table.at(-h_).share, 1.0, 0.05) << "all wall: 1, the lattice's own error apart";
    EXPECT_EQ(table.at(-3.0 * h_).share, table.at(-h_).share);
    EXPECT_EQ(table.at(std::numeric_limits<double>::infinity()).share, table.at(h_).share);
    EXPECT_TRUE(std::isfinite(table.at(std::numeric_limits<double>::quiet_NaN()).share));
  }
}

TEST_P(ShareTableTest, curvedSlopeIsTheDerivativeOfTheCurvedShare) {
  const ShareTable<double> table{settings_, 1.0 / (6.0 * kSpacing)};
  for (int k = -18; k < 19; ++k) {
    const double d = 0.0493 * k * h_;
    const double step = 2.0 * h_ / (ShareTable<double>::kNodes - 1);
    const double slope = (table.at(d + step).share - table.at(d - step).share) / (2.0 * step);
    EXPECT_NEAR(table.at(d).slope * kSpacing, slope * kSpacing, 5e-4) << d;
  }
}

TEST_P(ShareTableTest, curvedRatio) {
  const SmoothingKernel& kernel = settings_.kernel;
  for (int k = -20; k <= 20; ++k) {
    const double d = 0.05 * k * h_;
    EXPECT_NEAR(curvedRatio(kernel, 1.0 / (1e5 * kSpacing), d), 1.0, 1e-4);
    const double hollow = curvedRatio(kernel, 1.0 / (6.0 * kSpacing), d);
    const double ball = curvedRatio(kernel, -1.0 / (6.0 * kSpacing), d);
    EXPECT_GE(hollow, 1.0 - 1e-9) << "a hollow wall reaches round the particle";
    EXPECT_LE(ball, 1.0 + 1e-9);
    EXPECT_GE(ball, 0.5);
    EXPECT_LE(hollow, 2.0);
  }
  EXPECT_EQ(curvedRatio(kernel, 0.0, 0.3 * h_), 1.0);
  EXPECT_GT(curvedRatio(kernel, 1.0 / (6.0 * kSpacing), 0.5 * kSpacing), 1.05);
}

// The ratio by brute force: midpoint cells of the ball around the particle.
TEST_P(ShareTableTest, curvedRatioAgainstBruteForce) {
  const double radius = 6.0 * kSpacing;
  const int cells = 120;
  const double d = 0.25 * h_;  // a whole number of cells
  const double cell = 2.0 * h_ / cells;
  double plane = 0.0;
  double hollow = 0.0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        const double x = (i + 0.5) * cell - h_;
        const double y = (j + 0.5) * cell - h_;
        const double z = (k + 0.5) * cell - h_;
        const double w = settings_.kernel.value(vectorLength(x, y, z));
        if (z < -d) plane += w;
        if (vectorLength(x, y, z - (radius - d)) > radius) hollow += w;
      }
    }
  }
  EXPECT_NEAR(curvedRatio(settings_.kernel, 1.0 / radius, d), hollow / plane, 0.005);
}

INSTANTIATE_TEST_SUITE_P(supports, ShareTableTest, testing::Values(2.0, 2.5, 3.0));

}  // namespace
}  // namespace bleedsim::sph
