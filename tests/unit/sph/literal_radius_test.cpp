// Equation (34) as printed: h <- lambda (m/rho)^(1/d) after every step, within what the grid follows.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "service/sph/effects/literal_core_radius.h"
#include "tests/unit/sph/literal_scenes.h"

namespace bleedsim::sph {
namespace {

/// The effect alone: nothing moves.
WorldDescription withRadius(WorldDescription description, double support_ratio = 2.0) {
  description.effects = {};
  description.support_ratio = support_ratio;
  return literal(description, {.core_radius = true});
}

/// In the order of the particles' ids.
struct Radii {
  std::vector<Vec3> position;
  std::vector<double> over_h;
};

Radii radiiOf(const World& world) {
  FrameBuffer frame;
  frame.reserve(world.description().capacity, kFrameRadius);
  world.copyFrame(frame, kFrameRadius);
  std::vector<std::uint32_t> by_id(frame.count);
  for (std::uint32_t i = 0; i < frame.count; ++i) by_id[i] = i;
  std::sort(by_id.begin(), by_id.end(), [&](std::uint32_t a, std::uint32_t b) { return frame.id[a] < frame.id[b]; });
  Radii radii;
  for (const std::uint32_t i : by_id) {
    radii.position.push_back(test::positionOf(frame, i));
    radii.over_h.push_back(static_cast<double>(frame.radius[i]) / world.description().supportRadius());
  }
  return radii;
}

void step(World& world, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_TRUE(world.step(1.0).ok());
}

/// (34) from the radii before it: sums of poly6 of each particle's own radius, the nearest images across periodic sides.
std::vector<double> following(const WorldDescription& d, const Radii& before) {
  const SmoothingKernel at_h = d.densityKernel();
  const RadiusBounds bounds = literalRadiusBounds(d.support_ratio);
  const double lambda = d.support_ratio;
  std::vector<double> after;
  for (std::size_t i = 0; i < before.position.size(); ++i) {
    const SmoothingKernel own{at_h.type, before.over_h[i] * at_h.h, at_h.layer};
    double volume_sum = 0.0;  // rho_i/m, 1/m^3
    for (const Vec3& position : before.position) {
      Vec3 offset = position - before.position[i];
      for (Eigen::Index a = 0; a < 3; ++a) {
        const double side = d.domain.upper[a] - d.domain.lower[a];
        if (d.domain.periodic[static_cast<std::size_t>(a)]) offset[a] -= side * std::round(offset[a] / side);
      }
      volume_sum += own.value(offset.norm());
    }
    const double room = d.planar ? std::sqrt(1.0 / (volume_sum * d.spacing)) : std::cbrt(1.0 / volume_sum);
    after.push_back(std::clamp(lambda * room / at_h.h, bounds.smallest, bounds.largest));
  }
  return after;
}

struct Shape {
  const char* name;
  WorldDescription description;
  std::vector<double> middle;  ///< radii over h of the particle in the middle after 1, 2, ... steps and in the end
  double tolerance;
};

class RadiusOf : public testing::TestWithParam<Shape> {};

// Every step of every particle: the passes' float sums of at most 60 neighbours, and float positions, keep 1e-5.
TEST_P(RadiusOf, IsWhatTheEquationSays) {
  for (const Precision precision : {Precision::float32, Precision::float64}) {
    const WorldDescription& description = GetParam().description;
    const auto world = test::makeWorld(description, {.precision = precision});
    for (int k = 0; k < 12; ++k) {
      const std::vector<double> expected = following(description, radiiOf(*world));
      step(*world, 1);
      const Radii now = radiiOf(*world);
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(now.over_h[i], expected[i], 1e-5) << "step " << k;
    }
    EXPECT_EQ(test::counterOf(*world, Counter::neighbor_overflow), 0u);
  }
}

TEST_P(RadiusOf, HasTheValuesOfClosedForms) {
  const auto world = test::makeWorld(GetParam().description);
  const auto middle = [&] {
    const Radii now = radiiOf(*world);
    const auto nearest = std::min_element(now.position.begin(), now.position.end(),
                                          [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
    return now.over_h[static_cast<std::size_t>(nearest - now.position.begin())];
  };
  const std::vector<double>& expected = GetParam().middle;
  for (std::size_t k = 0; k + 1 < expected.size(); ++k) {
    step(*world, 1);
    EXPECT_NEAR(middle(), expected[k], GetParam().tolerance) << "after step " << k + 1;
  }
  step(*world, 40);
  EXPECT_NEAR(middle(), expected.back(), GetParam().tolerance);
}

/// 1.161: (315/(64 pi))^(1/3), from W(0) of poly6.
const double kLone = 1.0 / std::cbrt(64.0 * std::numbers::pi / 315.0);

WorldDescription lone(double ratio) { return withRadius(test::freeBlock({1, 1, 1}), ratio); }

std::vector<Shape> shapes() {
  // A particle alone, physics.md section 1: times lambda/1.161 in every step, up to the bound of 3.75 dx.
  const double slow = 1.5 / kLone;
  std::vector<Shape> all{
      {"Particle", lone(2.0), {2.0 / kLone, 1.875}, 1e-5},
      {"ParticleOfAWideSupport", lone(2.5), {1.5, 1.5}, 1e-5},
      {"ParticleOfANarrowSupport", lone(1.5), {slow, slow * slow, slow * slow * slow, 2.5}, 2e-5},
  };
  // Two particles dx apart at h = 2 dx: rho/m = W(0) (1 + (1 - 1/4)^3).
  all.push_back({"Pair", withRadius(test::freeBlock({2, 1, 1})), {2.0 / kLone / std::cbrt(1.0 + 27.0 / 64.0), 1.875}, 1e-5});
  // On a line rho/m = 35/(32 pi) 315/(64 h^2 dx)...: unbounded it would end at lambda^2/1.43 = 2.79.
  all.push_back({"Filament", withRadius(test::freeBlock({31, 1, 1})), {1.875}, 1e-5});
  // In a layer int W dA = 315/(256 h): h = lambda^(3/2) dx/(315/256)^(1/2), 1.275 of lambda dx; the lattice's sum is 1 % off
  // that.
  all.push_back({"Film", withRadius(test::freeBlock({21, 21, 1})), {std::sqrt(2.0 * 256.0 / 315.0)}, 0.015});
  // m = 0.99 rho0 dx^3: 0.997 (physics.md section 1).
  all.push_back({"Bulk", withRadius(test::periodicBox({12, 12, 12})), {0.9967, 0.997}, 1e-3});
  // In a planar world rho/m = 4/(pi h^2 dx) for one alone.
  WorldDescription planar = withRadius(layer(1, 1));
  all.push_back({"PlanarParticle", planar, {2.0 * std::sqrt(std::numbers::pi / 4.0), 1.875}, 1e-5});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shapes, RadiusOf, testing::ValuesIn(shapes()),
                         [](const auto& tested) { return std::string{tested.param.name}; });

// physics.md section 1: 1.08 at a half space's surface.
TEST(LiteralRadius, GrowsAtTheSurface) {
  const auto world = test::makeWorld(withRadius(test::freeBlock({13, 13, 13})));
  step(*world, 40);
  const Radii now = radiiOf(*world);
  int found = 0;
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    const Vec3& x = now.position[i];
    if (std::hypot(x.x(), x.y()) > 1e-5) continue;
    if (std::abs(std::abs(x.z()) - 6.0 * test::kSpacing) < 1e-5) {
      EXPECT_NEAR(now.over_h[i], 1.08, 0.01);
      ++found;
    }
    if (std::abs(x.z()) < 3.5 * test::kSpacing) { EXPECT_NEAR(now.over_h[i], 0.997, 0.002); }
  }
  EXPECT_EQ(found, 2);
}

// Tissue's share of density is made at the particle's own radius, so that a wall is no surface: within 1 % of the bulk's radius,
// of which the faces' share takes the wall's error and the edges' theirs.
TEST(LiteralRadius, TissueIsNoSurface) {
  const auto world = test::makeWorld(withRadius(test::closedBox({8, 8, 8})));
  step(*world, 40);
  for (const double radius : radiiOf(*world).over_h) EXPECT_NEAR(radius, 0.997, 0.01);
}

// Particles on one spot: rho/m = n W(0), so a shrinking radius makes them denser still. The bound ends it.
TEST(LiteralRadius, ACrowdOnOneSpotShrinksToTheBound) {
  WorldDescription description = withRadius(test::freeBlock({1, 1, 1}));
  for (int k = 1; k < 30; ++k) description.fluid_blocks.push_back(description.fluid_blocks.front());
  description.capacity = 30;
  const auto world = test::makeWorld(description);
  step(*world, 30);
  const Radii now = radiiOf(*world);
  ASSERT_EQ(now.over_h.size(), 30u);
  for (const double radius : now.over_h) EXPECT_NEAR(radius, 0.5, 1e-6);
}

// The settings of core_radius are the sound model's: bounds and relaxation do not act here.
TEST(LiteralRadius, DoesNotReadTheSoundSettings) {
  WorldDescription description = lone(2.0);
  description.effects.core_radius = CoreRadiusSettings{.smallest = 1.0, .largest = 1.0, .relaxation = 0.01};
  const auto world = test::makeWorld(description);
  step(*world, 3);
  EXPECT_NEAR(radiiOf(*world).over_h.front(), 1.875, 1e-6);
}

TEST(LiteralRadius, NeedsThreeOfItsReachesAcrossAPeriodicSide) {
  EXPECT_TRUE(createWorld(withRadius(test::periodicBox({12, 12, 12})), {}).ok());
  const auto narrow = createWorld(withRadius(test::periodicBox({12, 11, 12})), {});
  ASSERT_FALSE(narrow.ok());
  EXPECT_NE(narrow.status().message().find("three of the largest support radii"), std::string::npos) << narrow.status().message();
}

TEST(LiteralRadius, IsTakenOverAndLeftByARunningWorld) {
  WorldDescription with = literal(test::freeBlock({6, 6, 6}, 0.2), {PressureTerm::symmetric, true, true, true, true, true});
  WorldDescription without = with;
  without.effects.core_radius.reset();
  const auto first = test::makeWorld(without);
  step(*first, 5);
  const auto second = test::makeWorld(with);
  ASSERT_TRUE(second->adopt(*first).ok());
  for (const double radius : radiiOf(*second).over_h) EXPECT_NEAR(radius, 1.0, 1e-6);
  step(*second, 5);
  const Radii grown = radiiOf(*second);
  EXPECT_GT(*std::max_element(grown.over_h.begin(), grown.over_h.end()), 1.05);
  const auto third = test::makeWorld(without);
  ASSERT_TRUE(third->adopt(*second).ok());
  step(*third, 5);
  EXPECT_FALSE(third->faulted());
  EXPECT_EQ(test::statsOf(*third).particles, 216u);
}

}  // namespace
}  // namespace bleedsim::sph
