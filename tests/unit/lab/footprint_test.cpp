// The footprint's figures on bodies whose figures are known.
#include "service/lab/footprint.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace bleedsim::lab {
namespace {

constexpr double kSpacing = 0.001;
constexpr FootprintOptions kOptions{.spacing = kSpacing};

/// A square lattice of particles where `inside(x, y)` holds, in layers up to height(x, y).
template <class Inside, class Height>
std::vector<float> lattice(double extent, Inside&& inside, Height&& height) {
  std::vector<float> position;
  const int reach = static_cast<int>(extent / kSpacing);
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const double x = ix * kSpacing;
      const double y = iy * kSpacing;
      if (!inside(x, y)) continue;
      for (double z = 0.5 * kSpacing; z < height(x, y); z += kSpacing) {
        position.insert(position.end(), {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
      }
    }
  }
  return position;
}

std::vector<float> disc(double radius, double height) {
  return lattice(
      radius, [radius](double x, double y) { return std::hypot(x, y) <= radius; }, [height](double, double) { return height; });
}

TEST(Footprint, OfNothingIsZero) {
  const Footprint footprint = footprintOf({}, kOptions);
  EXPECT_EQ(footprint.area, 0.0);
  EXPECT_EQ(footprint.serration, 0.0);
  EXPECT_EQ(footprint.pieces, 0u);
}

// The outermost points of a lattice stand dx/2 within the circle in the mean and are drawn 0.75 dx wide with scallops between
// them: the drawn edge is the circle to about dx/4, which is 2 % of the area at 30 dx. The perimeter follows the scallops too.
TEST(Footprint, OfADiscHasItsAreaAndPerimeter) {
  const double radius = 30 * kSpacing;
  const Footprint footprint = footprintOf(disc(radius, 2 * kSpacing), kOptions);
  EXPECT_NEAR(footprint.area, std::numbers::pi * radius * radius, 0.02 * footprint.area);
  EXPECT_NEAR(footprint.perimeter, 2.0 * std::numbers::pi * radius, 0.08 * footprint.perimeter);
  EXPECT_NEAR(footprint.serration, 4.0 * std::numbers::pi, 0.15 * 4.0 * std::numbers::pi);
  EXPECT_EQ(footprint.pieces, 1u);
}

TEST(Footprint, ARaggedEdgeIsMoreSerratedThanASmoothOne) {
  const double radius = 25 * kSpacing;
  const auto star = [radius](double x, double y) {
    return std::hypot(x, y) <= radius * (0.85 + 0.15 * std::cos(12.0 * std::atan2(y, x)));
  };
  const auto flat = [](double, double) { return 1.5 * kSpacing; };
  const Footprint ragged = footprintOf(lattice(radius, star, flat), kOptions);
  const Footprint smooth = footprintOf(disc(radius, 1.5 * kSpacing), kOptions);
  EXPECT_GT(ragged.serration, 1.5 * smooth.serration);
}

// The spheres of a flat layer leave ripples of their own; a checkerboard of one more layer is rougher by far.
TEST(Footprint, BumpsAreRough) {
  const double radius = 20 * kSpacing;
  const auto everywhere = [radius](double x, double y) { return std::hypot(x, y) <= radius; };
  const auto bumps = [](double x, double y) {
    const bool high = (std::lround(x / kSpacing) / 3 + std::lround(y / kSpacing) / 3) % 2 == 0;
    return (high ? 4.0 : 1.0) * kSpacing;
  };
  const Footprint rough = footprintOf(lattice(radius, everywhere, bumps), kOptions);
  const Footprint flat = footprintOf(disc(radius, 2 * kSpacing), kOptions);
  EXPECT_LT(flat.roughness, 0.15 * kSpacing);
  EXPECT_GT(rough.roughness, 4.0 * flat.roughness);
  EXPECT_LT(rough.roughness, 3.0 * kSpacing) << "no bump is higher than three spacings";
}

TEST(Footprint, HeightsAreThoseOfTheSpheres) {
  const Footprint footprint = footprintOf(disc(20 * kSpacing, 3 * kSpacing), kOptions);
  // The nearest cell centres stand dx/4 off a particle along both axes.
  const double top = 2.5 + std::sqrt(0.75 * 0.75 - 2 * 0.25 * 0.25);
  EXPECT_NEAR(footprint.largest_height, top * kSpacing, 1e-3 * kSpacing);
  EXPECT_GT(footprint.mean_height, 2.8 * kSpacing);
  EXPECT_LT(footprint.mean_height, footprint.largest_height);
}

// A half sphere: V = 2/3 pi R^3 and A = 3 pi R^2 give a sphericity of 2^(2/3) 2/3 x ... = 0.840.
TEST(Footprint, AHalfSphereIsRounderThanADisc) {
  const double radius = 15 * kSpacing;
  const auto dome = lattice(
      radius, [radius](double x, double y) { return std::hypot(x, y) <= radius; },
      [radius](double x, double y) { return std::sqrt(std::max(0.0, radius * radius - x * x - y * y)); });
  const double expected = std::cbrt(std::numbers::pi) * std::pow(4.0 * std::numbers::pi, 2.0 / 3.0) / (3.0 * std::numbers::pi);
  EXPECT_NEAR(footprintOf(dome, kOptions).sphericity, expected, 0.1 * expected);
  EXPECT_LT(footprintOf(disc(radius, kSpacing), kOptions).sphericity, 0.5 * expected);
}

TEST(Footprint, PartsThatDoNotTouchAreCounted) {
  std::vector<float> two = disc(5 * kSpacing, kSpacing);
  const std::vector<float> other = disc(4 * kSpacing, kSpacing);
  for (std::size_t i = 0; i < other.size(); i += 3) two.insert(two.end(), {other[i] + 0.02f, other[i + 1], other[i + 2]});
  EXPECT_EQ(footprintOf(two, kOptions).pieces, 2u);
}

TEST(Footprint, ParticlesThatAreNotFiniteAreLeftOut) {
  std::vector<float> position = disc(5 * kSpacing, kSpacing);
  const Footprint clean = footprintOf(position, kOptions);
  position.insert(position.end(), {std::nanf(""), 0.0f, 0.0f, 0.0f, INFINITY, 0.0f});
  EXPECT_EQ(footprintOf(position, kOptions).area, clean.area);
}

TEST(HeightProfile, OfADiscIsFlatThenNothing) {
  const double radius = 20 * kSpacing;
  const HeightProfile profile = heightProfile(disc(radius, 2 * kSpacing), kOptions, 0.0, 0.0, 4 * kSpacing, 10);
  ASSERT_EQ(profile.height.size(), 10u);
  EXPECT_DOUBLE_EQ(profile.radius[0], 2 * kSpacing);
  // The ring's cells are counted by its area: a few more or fewer cells stand in it, 10 %.
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(profile.height[k], 2.15 * kSpacing, 0.25 * kSpacing) << k;
  for (std::size_t k = 6; k < 10; ++k) EXPECT_EQ(profile.height[k], 0.0) << k;
}

}  // namespace
}  // namespace bleedsim::lab
