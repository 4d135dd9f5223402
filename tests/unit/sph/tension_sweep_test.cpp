// The two walks of surface tension against the oracle in double precision, and what they give on simple shapes.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/support/drops.h"
#include "tests/support/tension_rig.h"
#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

using test::bruteForceTension;
using test::OracleParticles;
using test::TensionFields;

WorldDescription withTension(WorldDescription description) {
  description.effects = {};
  description.effects.surface_tension.emplace();
  return description;
}

/// 9 x 8 x 7 stirred particles in open space.
WorldDescription block() { return withTension(test::freeBlock({9, 8, 7}, 0.3)); }

/// The description's particles at rest.
OracleParticles still(const WorldDescription& description) {
  OracleParticles particles = stirred(description);
  for (Vec3& velocity : particles.velocity) velocity = Vec3::Zero();
  return particles;
}

std::vector<Vec3> withoutMean(std::vector<Vec3> field) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : field) sum += v;
  for (Vec3& v : field) v -= sum / static_cast<double>(field.size());
  return field;
}

template <class Real>
void expectOracle(const WorldDescription& description, SimdTarget target, double tolerance,
                  const std::vector<double>& radius = {}) {
  const TensionRig<Real> rig{description, target, stirred(description), 1, radius};
  const bool held = !description.tissue.empty();
  const TensionFields oracle =
      bruteForceTension(description, rig.rounded(), radius, held ? rig.tissue() : std::vector<test::TissueAt>{});
  const std::vector<Vec3> expected = held ? oracle.acceleration : withoutMean(oracle.acceleration);
  const double scale = largestNorm(expected);
  ASSERT_GT(scale, 1.0) << "nothing is compared";
  EXPECT_LE(largestDifference(rig.acceleration(), expected), tolerance * scale);
}

/// Every target against double precision: so wide and scalar agree, too. 1e-5: float sums of some thirty terms, cut at a ramp of
/// slope 1/cut-off.
void expectOracleOnAllTargets(const WorldDescription& description, const std::vector<double>& radius = {}) {
  expectOracle<double>(description, SimdTarget::scalar, 1e-11, radius);
  for (const SimdTarget target : availableSimdTargets()) {
    SCOPED_TRACE(simdTargetName(target));
    expectOracle<float>(description, target, 1e-5, radius);
  }
}

TEST(TensionSweeps, EqualTheOracle) {
  for (const double ratio : {2.0, 2.5, 3.0}) {
    SCOPED_TRACE(ratio);
    WorldDescription description = block();
    description.support_ratio = ratio;
    expectOracleOnAllTargets(description);
  }
}

TEST(TensionSweeps, EqualTheOracleAcrossPeriodicSides) {
  WorldDescription description = block();
  description.domain.lower = {-0.0045, -0.004, -0.02};
  description.domain.upper = {0.0045, 0.004, 0.02};
  description.domain.periodic = {true, true, false};
  expectOracleOnAllTargets(description);
}

TEST(TensionSweeps, EqualTheOracleWithRadiiOfTheirOwn) {
  WorldDescription description = block();
  description.effects.core_radius.emplace();
  std::vector<double> radius;
  for (std::size_t i = 0; i < std::size_t{9 * 8 * 7}; ++i) {
    radius.push_back(description.supportRadius() * (1.0 - 0.0625 * static_cast<double>(i % 3)));
  }
  expectOracleOnAllTargets(description, radius);
}

TEST(TensionSweeps, EqualTheOracleOnTissue) {
  WorldDescription description = block();
  description.tissue.push_back({.name = "plane", .shape = PlaneShape{.point = {0.0, 0.0, -0.0035}}});
  expectOracleOnAllTargets(description);
  description.effects.surface_tension->contact_angle = 1.2;
  expectOracleOnAllTargets(description);
}

TEST(TensionSweeps, GiveTheSameBitsForAnyNumberOfShares) {
  WorldDescription description = block();
  description.tissue.push_back({.name = "plane", .shape = PlaneShape{.point = {0.0, 0.0, -0.0035}}});
  const TensionRig<float> one{description, SimdTarget::automatic, stirred(description)};
  description.tissue.clear();
  const TensionRig<float> free_one{description, SimdTarget::automatic, stirred(description)};
  for (const int shares : {2, 3, 5}) {
    const TensionRig<float> free_many{description, SimdTarget::automatic, stirred(description), shares};
    EXPECT_EQ(free_one.acceleration(), free_many.acceleration()) << shares;
  }
  description.tissue.push_back({.name = "plane", .shape = PlaneShape{.point = {0.0, 0.0, -0.0035}}});
  for (const int shares : {2, 3, 5}) {
    const TensionRig<float> many{description, SimdTarget::automatic, stirred(description), shares};
    EXPECT_EQ(one.acceleration(), many.acceleration()) << shares;
  }
}

// kappa of a plane is 0. Periodic slab; the scale to compare with is that of a sphere as sharp as the kernel, kappa = 2/h.
TEST(TensionSweeps, LeaveAFlatSurfaceAlone) {
  WorldDescription description = withTension(test::freeBlock({12, 12, 10}));
  description.domain.lower = {-0.006, -0.006, -0.02};
  description.domain.upper = {0.006, 0.006, 0.02};
  description.domain.periodic = {true, true, false};
  const TensionRig<float> rig{description, SimdTarget::automatic, still(description)};
  const double h = description.supportRadius();
  const double sharp = 2.0 * description.effects.surface_tension->coefficient / description.rest_density * 2.0 / (h * h);
  EXPECT_LT(largestNorm(rig.acceleration()), 1e-5 * sharp);
}

TEST(TensionSweeps, PullADropInwards) {
  WorldDescription description = withTension(test::emptyScene());
  test::addBall(description, Vec3::Zero(), 0.006);
  const TensionRig<float> rig{description, SimdTarget::automatic, still(description)};
  const OracleParticles particles = rig.rounded();
  double inwards = 0.0;
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    const double pull = -rig.acceleration()[i].dot(particles.position[i].normalized());
    if (particles.position[i].norm() > 0.0055) { EXPECT_GT(pull, 0.0) << i; }
    inwards += pull;
  }
  EXPECT_GT(inwards, 0.0);
}

// A cavity shrinks: the force points to its middle, too.
TEST(TensionSweeps, PullACavityShut) {
  WorldDescription description = withTension(test::emptyScene());
  test::addBall(description, Vec3::Zero(), 0.01, [](const Vec3& x) { return x.norm() > 0.004; });
  const TensionRig<float> rig{description, SimdTarget::automatic, still(description)};
  const OracleParticles particles = rig.rounded();
  double inwards = 0.0;
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    if (particles.position[i].norm() > 0.005) continue;
    inwards -= rig.acceleration()[i].dot(particles.position[i].normalized());
  }
  EXPECT_GT(inwards, 0.0);
}

TEST(TensionSweeps, StayFiniteOnSparseShapes) {
  const double dx = test::kSpacing;
  const auto expect_finite = [](const std::vector<Vec3>& positions, const char* name) {
    WorldDescription description = withTension(test::emptyScene());
    OracleParticles particles;
    for (const Vec3& position : positions) {
      particles.position.push_back(position);
      particles.velocity.push_back(Vec3::Zero());
    }
    for (const SimdTarget target : availableSimdTargets()) {
      const TensionRig<float> rig{description, target, particles};
      for (const Vec3& a : rig.acceleration()) EXPECT_TRUE(a.allFinite()) << name;
    }
    if (positions.size() == 1) {
      const TensionRig<float> rig{description, SimdTarget::automatic, particles};
      EXPECT_EQ(rig.acceleration().front(), Vec3::Zero()) << name;
    }
  };
  std::vector<Vec3> film;
  std::vector<Vec3> filament;
  for (int i = 0; i < 10; ++i) {
    filament.push_back({i * dx, 0.0, 0.0});
    for (int j = 0; j < 10; ++j) film.push_back({i * dx, j * dx, 0.0});
  }
  expect_finite({Vec3::Zero()}, "isolated particle");
  expect_finite({Vec3::Zero(), {dx, 0.0, 0.0}}, "pair");
  expect_finite({Vec3::Zero(), Vec3::Zero()}, "coincident pair");
  expect_finite(film, "film");
  expect_finite(filament, "filament");
}

// Two bodies that do not touch: each keeps its own momentum; held by tissue, a body keeps its force.
TEST(TensionSweeps, MoveNoFreeBody) {
  const auto sums_of = [](double gap, bool tissue) {
    WorldDescription description = withTension(test::freeBlock({6, 5, 4}, 0.3));
    FluidBlock other = description.fluid_blocks.front();
    other.lower.x() += 0.006 + gap;
    other.upper.x() += 0.006 + gap;
    description.fluid_blocks.push_back(other);
    if (tissue)
      description.tissue.push_back(
          {.name = "plane", .shape = PlaneShape{.point = {-0.003, 0.0, 0.0}, .normal = {1.0, 0.0, 0.0}}});
    const TensionRig<float> rig{description, SimdTarget::automatic, stirred(description), 2};
    std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
    double size = 0.0;
    for (std::size_t i = 0; i < rig.acceleration().size(); ++i) {
      sums[i / 120] += rig.acceleration()[i];
      size += rig.acceleration()[i].norm();
    }
    return std::array<double, 2>{sums[0].norm() / size, sums[1].norm() / size};
  };
  const auto apart = sums_of(0.0026, false);  // more than h = 2 mm between the jittered faces
  EXPECT_LT(apart[0], 1e-6);
  EXPECT_LT(apart[1], 1e-6);
  const auto joined = sums_of(0.001, false);
  EXPECT_GT(joined[0], 1e-5);
  EXPECT_GT(joined[1], 1e-5);
  const auto held = sums_of(0.0026, true);
  EXPECT_GT(held[0], 1e-5);
  EXPECT_LT(held[1], 1e-6);
}

}  // namespace
}  // namespace bleedsim::sph
