#include "service/sph/tissue/share_rule.h"

#include <gtest/gtest.h>
#include <numbers>

#include "service/sph/smoothing_kernel.h"
#include "service/sph/tissue/wall_combination.h"

namespace bleedsim::sph {
namespace {

TEST(ShareRule, arcSine) {
  for (int k = 0; k <= 1000; ++k) {
    const double c = k / 1000.0;
    EXPECT_NEAR(arcSine(c), std::asin(c), 3e-8) << c;
    EXPECT_NEAR(arcSine(static_cast<float>(c)), std::asin(c), 2e-6) << c;
  }
  EXPECT_EQ(arcSine(1.0 + 1e-9), arcSine(1.0)) << "a rounded scalar product may exceed 1";
  EXPECT_EQ(wedgeWeight(-0.5), wedgeWeight(0.5));
}

TEST(ShareRule, limits) {
  for (const double a : {0.0, 0.1, 0.4, 0.9}) {
    for (const double b : {0.0, 0.2, 0.4, 0.8}) {
      EXPECT_NEAR(overlapOf(a, b, 0.0).value, a * b, 1e-7) << "perpendicular: the product";
      EXPECT_NEAR(overlapOf(a, b, 1e-9).value, overlapOf(a, b, -1e-9).value, 1e-7) << "continuous there";
      EXPECT_NEAR(overlapOf(a, b, 1.0).value, std::min(a, b), 1e-7) << "parallel: the one that is behind the other";
      EXPECT_NEAR(overlapOf(a, b, -1.0).value, std::max(0.0, a + b - 1.0), 1e-7) << "facing";
      EXPECT_DOUBLE_EQ(overlapOf(a, b, 0.3).value, overlapOf(b, a, 0.3).value);
    }
  }
}

TEST(ShareRule, partialDerivatives) {
  const double step = 1e-6;
  for (const double c : {-0.9, -0.3, 0.0, 0.4, 0.8}) {
    for (const double a : {0.1, 0.35, 0.7}) {
      for (const double b : {0.15, 0.5, 0.8}) {
        const auto at = overlapOf(a, b, c);
        EXPECT_NEAR((overlapOf(a + step, b, c).value - overlapOf(a - step, b, c).value) / (2 * step), at.by_first, 1e-8);
        EXPECT_NEAR((overlapOf(a, b + step, c).value - overlapOf(a, b - step, c).value) / (2 * step), at.by_second, 1e-8);
        if (std::abs(c) < 0.1) continue;
        const double by_c = (overlapOf(a, b, c + step).value - overlapOf(a, b, c - step).value) / (2 * step);
        const double w_by_c = (wedgeWeight(c + step) - wedgeWeight(c - step)) / (2 * step);
        EXPECT_NEAR(by_c, at.by_weight * w_by_c, 1e-6);
      }
    }
  }
}

WallTerm<double> termOf(const std::array<double, 3>& normal, double share, double distance = 0.0) {
  WallTerm<double> term{};
  term.distance = distance;
  term.normal = normal;
  term.share = share;
  return term;
}

WallTerms<double> threeWalls(const std::array<double, 3>& shares) {
  const double root = std::numbers::sqrt2 / 2.0;
  const std::array<std::array<double, 3>, 3> normals{{{0, 0, 1}, {root, 0, root}, {0, 0.6, -0.8}}};
  WallTerms<double> terms;
  for (std::size_t k = 0; k < 3; ++k) terms.add(termOf(normals[k], shares[k]));
  return terms;
}

TEST(ShareRule, weightsAreTheDerivativesOfThreeSkewWalls) {
  const std::array<double, 3> shares{0.2, 0.45, 0.3};
  const auto combined = combineShares(threeWalls(shares));
  EXPECT_GT(combined.share, 0.45);
  EXPECT_LT(combined.share, 0.95);
  const double step = 1e-6;
  for (std::size_t k = 0; k < 3; ++k) {
    auto more = shares;
    auto less = shares;
    more[k] += step;
    less[k] -= step;
    const double slope = (combineShares(threeWalls(more)).share - combineShares(threeWalls(less)).share) / (2 * step);
    EXPECT_NEAR(slope, combined.weight[k], 1e-8) << k;
  }
}

TEST(ShareRule, aWallThatAddsNothingChangesNothing) {
  WallTerms<double> one;
  one.add(termOf({0, 0, 1}, 0.3));
  WallTerms<double> two = one;
  two.add(termOf({0, 0.6, 0.8}, 0.0));
  EXPECT_NEAR(combineShares(one).share, combineShares(two).share, 1e-15);
  EXPECT_NEAR(combineShares(two).weight[0], 1.0, 1e-15);
}

TEST(ShareRule, keepsTheNearestWallsWhenThereAreTooMany) {
  WallTerms<double> terms;
  for (int k = 0; k < 20; ++k) terms.add(termOf({0, 0, 1}, 0.1, (k * 7) % 20));
  ASSERT_EQ(terms.size(), WallTerms<double>::kMost);
  for (int k = 0; k < terms.size(); ++k) EXPECT_LT(terms[k].distance, WallTerms<double>::kMost);
}

// A wedge of blood, 30 to 150 degrees, against sums over cells: what walls.md promises is .036.
TEST(ShareRule, wedgesAgainstBruteForce) {
  const SmoothingKernel kernel{.h = 1.0};
  const int cells = 40;
  const double cell = 2.0 / cells;
  for (const double degrees : {30.0, 60.0, 90.0, 120.0, 150.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double nx = std::sin(angle);
    const double nz = -std::cos(angle);
    for (const double first_distance : {0.1, 0.25, 0.5}) {
      for (const double second_distance : {0.1, 0.25, 0.5}) {
        double first = 0.0;
        double second = 0.0;
        double either = 0.0;
        for (int i = 0; i < cells; ++i) {
          for (int j = 0; j < cells; ++j) {
            for (int k = 0; k < cells; ++k) {
              const double x = (i + 0.5) * cell - 1.0;
              const double y = (j + 0.5) * cell - 1.0;
              const double z = (k + 0.5) * cell - 1.0;
              const double w = kernel.value(std::sqrt(x * x + y * y + z * z)) * cell * cell * cell;
              const bool behind_first = z < -first_distance;
              const bool behind_second = nx * x + nz * z < -second_distance;
              if (behind_first) first += w;
              if (behind_second) second += w;
              if (behind_first || behind_second) either += w;
            }
          }
        }
        EXPECT_NEAR(first + second - overlapOf(first, second, nz).value, either, 0.036)
            << degrees << " degrees, " << first_distance << ", " << second_distance;
      }
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
