// Crowds: more neighbours than a list holds, more candidates than the buffer holds, more lists than their storage holds. Nothing
// may be left out, and the result may not depend on which path a particle took.
#include <gtest/gtest.h>

#include "service/sph/passes/pass_jobs.h"
#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

using test::bruteForce;
using test::OracleFields;

constexpr PairSet kSet{PressureTerm::variational, ViscosityTerm::uniform};

/// `count` particles thrown into a cube of `side` m about `center`.
void addCrowd(test::OracleParticles& particles, int count, const Vec3& center, double side) {
  JitterSource random{7};
  for (int k = 0; k < count; ++k) {
    const double x = random.next();
    const double y = random.next();
    particles.position.push_back(center + 0.5 * side * Vec3{x, y, random.next()});
    particles.velocity.push_back(0.2 * Vec3{y, x, random.next()});
  }
}

WorldDescription scene() { return withPairSet(test::freeBlock({1, 1, 1}), kSet); }

std::uint64_t countAbove(const OracleFields& oracle, int neighbors) {
  return static_cast<std::uint64_t>(
      std::count_if(oracle.neighbors.begin(), oracle.neighbors.end(), [&](int n) { return n > neighbors; }));
}

class Overflow : public testing::TestWithParam<SimdTarget> {
 protected:
  static int lanes() { return findPasses(GetParam(), {})->lanes; }

  void expectOracle(const PassRig<float>& rig, const OracleFields& oracle, double tolerance) {
    EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), tolerance);
    EXPECT_LT(largestDifference(rig.acceleration(), oracle.acceleration), tolerance * largestNorm(oracle.acceleration));
  }
};

TEST_P(Overflow, ListsThatAreTooLongEqualBruteForce) {
  test::OracleParticles particles;
  addCrowd(particles, 900, {0.001, 0.0013, -0.0008}, 0.005);
  addCrowd(particles, 301, {0.02, 0.0, 0.0}, 0.0012);
  const PassRig<float> rig{scene(), GetParam(), particles};
  const OracleFields oracle = bruteForce(scene(), kSet, rig.rounded());
  expectOracle(rig, oracle, 1e-5);
  const int limit = kMaxNeighbors - 2 * lanes();
  EXPECT_GE(rig.overflowed(), 301u);
  EXPECT_LT(rig.overflowed(), 1201u) << "the sparser crowd must use lists too";
  EXPECT_EQ(rig.overflowed(), countAbove(oracle, limit));
}

TEST_P(Overflow, FiveThousandInOneCellEqualBruteForce) {
  test::OracleParticles particles;
  addCrowd(particles, 5000, {0.001, 0.001, 0.001}, 0.0019);
  addCrowd(particles, 10, {0.01, 0.01, 0.01}, 0.004);
  const PassRig<float> rig{scene(), GetParam(), particles};
  const OracleFields oracle = bruteForce(scene(), kSet, rig.rounded());
  expectOracle(rig, oracle, 5e-5);
  EXPECT_GE(rig.overflowed(), countAbove(oracle, kMaxNeighbors));
  EXPECT_LE(rig.overflowed(), 5000u);
}

TEST_P(Overflow, ListsBeyondTheirStorageEqualBruteForce) {
  WorldDescription description = withPairSet(test::freeBlock({16, 16, 16}, 0.2), kSet);
  test::OracleParticles particles = stirred(description);
  for (Vec3& position : particles.position) position *= 0.7;
  const PassRig<float> rig{description, GetParam(), particles};
  const OracleFields oracle = bruteForce(description, kSet, rig.rounded());
  ASSERT_EQ(countAbove(oracle, kMaxNeighbors - 2 * lanes()), 0u) << "every list fits by itself";
  EXPECT_GT(rig.overflowed(), 0u) << "together they do not";
  EXPECT_LT(rig.overflowed(), particles.position.size());
  expectOracle(rig, oracle, 1e-5);
}

TEST_P(Overflow, BitsDoNotDependOnWhichShareRunsOutOfStorage) {
  WorldDescription description = withPairSet(test::freeBlock({16, 16, 16}, 0.2), kSet);
  test::OracleParticles particles = stirred(description);
  for (Vec3& position : particles.position) position *= 0.7;
  const PassRig<float> one{description, GetParam(), particles, 1};
  const PassRig<float> two{description, GetParam(), particles, 2};
  ASSERT_NE(one.overflowed(), two.overflowed()) << "both shares have storage of their own";
  EXPECT_EQ(one.density(), two.density());
  EXPECT_EQ(one.acceleration(), two.acceleration());
}

TEST_P(Overflow, PeriodicCrowdAcrossACornerEqualsBruteForce) {
  WorldDescription description = withPairSet(test::periodicBox({7, 7, 7}), kSet);
  test::OracleParticles particles;
  addCrowd(particles, 600, Vec3::Zero(), 0.003);
  for (Vec3& position : particles.position) {
    for (double& x : position) x -= 0.007 * std::floor(x / 0.007);
  }
  const PassRig<float> rig{description, GetParam(), particles};
  EXPECT_GT(rig.overflowed(), 100u);
  expectOracle(rig, bruteForce(description, kSet, rig.rounded()), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(All, Overflow, testing::ValuesIn(availableSimdTargets()),
                         [](const auto& tested) { return std::string{simdTargetName(tested.param)}; });

TEST(OverflowReference, EqualsBruteForceToRoundOff) {
  test::OracleParticles particles;
  addCrowd(particles, 2500, {0.001, 0.001, 0.001}, 0.0019);
  const PassRig<double> rig{scene(), SimdTarget::scalar, particles};
  const OracleFields oracle = bruteForce(scene(), kSet, rig.rounded());
  EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-12);
  EXPECT_LT(largestDifference(rig.acceleration(), oracle.acceleration), 1e-12 * largestNorm(oracle.acceleration));
}

TEST(OverflowInAWorld, IsCountedAndStaysFinite) {
  WorldDescription description = test::freeBlock({4, 4, 4}, 0.4);
  for (int copy = 0; copy < 5; ++copy) description.fluid_blocks.push_back(description.fluid_blocks.front());
  const auto world = test::makeWorld(description);
  EXPECT_GT(test::counterOf(*world, Counter::neighbor_overflow), 0u);
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(world->step(1.0).ok());
  const std::uint64_t settled = test::counterOf(*world, Counter::neighbor_overflow);
  EXPECT_EQ(world->particleCount() + test::counterOf(*world, Counter::left_domain), 6u * 64u);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(world->step(1.0).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::neighbor_overflow), settled) << "the crowd has dispersed";
}

}  // namespace
}  // namespace bleedsim::sph
