// Blood at rest in front of tissue: the first row of a lattice seeded half a spacing away. Targets of walls.md.
#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

constexpr double kSide = 16 * kSpacing;  // beyond the reach of opposite faces

/// rho/rho0 - 1 in percent of the lattice point (i, j, k) in a container of that side, counted from its lower corner.
double firstRowError(double support_ratio, int i, int j, int k) {
  const ShareSettings settings = settingsFor(support_ratio);
  const auto field = fieldOf<double>({tissueOf(BoxShape{.upper = Vec3::Constant(kSide)})}, support_ratio);
  const auto at = [](int index) { return (index + 0.5) * kSpacing; };
  double density = 0.0;
  for (int a = 0; a < 16; ++a) {
    for (int b = 0; b < 16; ++b) {
      for (int c = 0; c < 16; ++c) {
        density += settings.particle_mass * settings.kernel.value(kSpacing * vectorLength<double>(a - i, b - j, c - k));
      }
    }
  }
  WallSample<double> wall;
  if (field.sample(at(i), at(j), at(k), wall)) density += kRestDensity * wall.share;
  return 100.0 * (density / kRestDensity - 1.0);
}

TEST(TissueRest, firstRowAtTwoSpacings) {
  EXPECT_NEAR(firstRowError(2.0, 7, 7, 7), 0.0, 1e-9);
  EXPECT_NEAR(firstRowError(2.0, 7, 7, 0), 0.1, 0.1);
  EXPECT_NEAR(firstRowError(2.0, 7, 0, 0), -0.1, 0.1);
  EXPECT_NEAR(firstRowError(2.0, 0, 0, 0), -0.5, 0.1);
}

TEST(TissueRest, firstRowAtTwoAndAHalfSpacings) {
  EXPECT_NEAR(firstRowError(2.5, 7, 7, 7), 0.0, 1e-9);
  EXPECT_NEAR(firstRowError(2.5, 7, 7, 0), -0.1, 0.1);
  EXPECT_NEAR(firstRowError(2.5, 7, 0, 0), -0.3, 0.1);
  EXPECT_NEAR(firstRowError(2.5, 0, 0, 0), -0.4, 0.1);
}

TEST(TissueRest, allFacesAlike) {
  EXPECT_NEAR(firstRowError(2.5, 15, 7, 7), firstRowError(2.5, 7, 7, 0), 1e-9);
  EXPECT_NEAR(firstRowError(2.5, 15, 7, 15), firstRowError(2.5, 7, 0, 0), 1e-9);
  EXPECT_NEAR(firstRowError(2.5, 15, 0, 15), firstRowError(2.5, 0, 0, 0), 1e-9);
}

// A floor up to the edge of a block's top face, blood above and beside it: the convex edge must not look denser or thinner than
// the concave one does. The lattice fills everything but the block.
TEST(TissueRest, convexEdgeOfABlock) {
  for (const double support_ratio : {2.0, 2.5}) {
    const ShareSettings settings = settingsFor(support_ratio);
    const BoxShape block{.lower = Vec3::Constant(-20 * kSpacing), .upper = Vec3::Zero(), .obstacle = true};
    const auto field = fieldOf<double>({tissueOf(block)}, support_ratio);
    const auto error = [&](int i, int j, int k) {
      double density = 0.0;
      for (int a = -4; a <= 4; ++a) {
        for (int b = -4; b <= 4; ++b) {
          for (int c = -4; c <= 4; ++c) {
            if (i + a < 0 && j + b < 0 && k + c < 0) continue;
            density += settings.particle_mass * settings.kernel.value(kSpacing * vectorLength<double>(a, b, c));
          }
        }
      }
      WallSample<double> wall;
      if (field.sample((i + 0.5) * kSpacing, (j + 0.5) * kSpacing, (k + 0.5) * kSpacing, wall)) {
        density += kRestDensity * wall.share;
      }
      return 100.0 * (density / kRestDensity - 1.0);
    };
    EXPECT_NEAR(error(-9, -9, 0), 0.0, 0.2) << "on the face";
    EXPECT_NEAR(error(-9, -1, 0), 0.0, 0.5) << "at the edge";
    EXPECT_NEAR(error(-9, 0, 0), 0.0, 0.5) << "off the edge";
    EXPECT_NEAR(error(-1, -1, 0), 0.0, 0.7) << "at the corner";
    EXPECT_NEAR(error(0, 0, 0), 0.0, 0.5) << "off the corner";
  }
}

}  // namespace
}  // namespace bleedsim::sph
