// Nearest neighbours and gush width against figures known by construction.
#include "service/lab/spread.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::lab {
namespace {

TEST(NeighborDistances, OfALatticeAreItsSpacing) {
  std::vector<float> position;
  for (int x = -5; x < 5; ++x)
    for (int y = -5; y < 5; ++y)
      for (int z = -5; z < 5; ++z) position.insert(position.end(), {0.001f * float(x), 0.001f * float(y), 0.001f * float(z)});
  const NeighborDistances distances = neighborDistances(position, 0.002);
  EXPECT_NEAR(distances.smallest, 0.001, 1e-9);
  EXPECT_NEAR(distances.median, 0.001, 1e-9);
  EXPECT_EQ(distances.alone, 0u);
}

TEST(NeighborDistances, FindThePairAndTheLonely) {
  const std::vector<float> position{0, 0, 0, 0.0003f, 0, 0, 0.1f, 0, 0, 0, -0.1f, 0};
  const NeighborDistances distances = neighborDistances(position, 0.002);
  EXPECT_NEAR(distances.smallest, 0.0003, 1e-9);
  EXPECT_EQ(distances.alone, 2u);
}

TEST(NeighborDistances, OfFewerThanTwoAreZero) {
  EXPECT_EQ(neighborDistances({}, 0.002).smallest, 0.0);
  const std::vector<float> one{0, 0, 0};
  EXPECT_EQ(neighborDistances(one, 0.002).smallest, 0.0);
  EXPECT_EQ(neighborDistances(one, 0.002).alone, 1u);
}

// Points spread evenly over a disc of radius R: 90 % of them are within sqrt(0.9) R of its middle.
TEST(GushWidth, IsThatOfTheDiscWithinTheHeights) {
  std::vector<float> position;
  const double radius = 0.004;
  for (int x = -40; x <= 40; ++x) {
    for (int y = -40; y <= 40; ++y) {
      const double px = 0.0001 * x;
      const double py = 0.0001 * y;
      if (std::hypot(px, py) > radius) continue;
      position.insert(position.end(), {static_cast<float>(px), static_cast<float>(py), 0.002f});
      position.insert(position.end(), {static_cast<float>(3 * px), static_cast<float>(3 * py), 0.01f});
    }
  }
  const double width = gushWidth(position, {.lower = 0.001, .upper = 0.003, .reach = 0.02});
  EXPECT_NEAR(width, 2.0 * std::sqrt(0.9) * radius, 0.03 * radius);
  EXPECT_EQ(gushWidth(position, {.lower = 0.02, .upper = 0.03, .reach = 0.02}), 0.0);
}

}  // namespace
}  // namespace bleedsim::lab
