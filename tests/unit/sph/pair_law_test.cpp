// Laws that hold for every set of pair effects: Newton's third law, momentum, finite values for particles on one spot.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

test::OracleParticles pairAt(const Vec3& first, const Vec3& second) {
  test::OracleParticles particles;
  particles.position = {first, second};
  particles.velocity = {{0.1, -0.2, 0.05}, {-0.1, 0.1, 0.15}};
  particles.viscosity = {0.003, 0.02};
  particles.platelet = {0.9, 0.4};
  particles.radius = {0.95, 1.2};
  return particles;
}

class PairLaw : public testing::TestWithParam<PairSet> {
 protected:
  /// With platelets where viscosity differs between particles, as it does with them.
  WorldDescription scene(const WorldDescription& base) const {
    WorldDescription description = withPairSet(base, GetParam());
    if (GetParam().viscosity == ViscosityTerm::harmonic) description.effects.platelets.emplace();
    return description;
  }

  /// Whether the set has a force between particles at a distance in m within the support.
  static bool pushesAt(double distance) {
    const PairSet set = GetParam();
    const bool touching = set.repulsion && distance < RepulsionSettings{}.contact_distance * test::kSpacing;
    return set.pressure != PressureTerm::none || set.viscosity != ViscosityTerm::none || touching;
  }
};

TEST_P(PairLaw, TwoParticlesPushEachOtherEqually) {
  // Two particles alone are never dense enough to push; background pressure makes them.
  WorldDescription description = scene(test::freeBlock({2, 1, 1}));
  if (description.effects.pressure) description.effects.pressure->background_pressure = 1e6;
  for (const double distance : {0.0019, 0.001, 0.0003, 1e-5}) {
    const Vec3 offset = distance * Vec3{0.6, 0.48, -0.64};
    const PassRig<double> reference{description, SimdTarget::scalar, pairAt({0.001, 0.0, 0.0}, Vec3{0.001, 0.0, 0.0} + offset)};
    const std::vector<Vec3>& a = reference.acceleration();
    EXPECT_LE((a[0] + a[1]).norm(), 1e-12 * a[0].norm()) << distance;
    EXPECT_EQ(a[0].norm() > 0.0, pushesAt(distance)) << distance;
    const std::vector<double>& rate = reference.plateletRate();
    EXPECT_EQ(rate[0] < 0.0, description.effects.platelets.has_value()) << "platelets go where they are fewer";
    EXPECT_LE(std::abs(rate[0] + rate[1]), 1e-12 * std::abs(rate[0])) << distance;
    for (const SimdTarget target : availableSimdTargets()) {
      const PassRig<float> rig{description, target, pairAt({0.001, 0.0, 0.0}, Vec3{0.001, 0.0, 0.0} + offset)};
      const std::vector<Vec3>& f = rig.acceleration();
      EXPECT_LE((f[0] + f[1]).norm(), 1e-6 * f[0].norm()) << distance;
    }
  }
}

TEST_P(PairLaw, PressureActsAlongThePairAndViscositySlowsIt) {
  WorldDescription description = scene(test::freeBlock({2, 1, 1}));
  const bool pressure = description.effects.pressure.has_value();
  if (pressure) description.effects.pressure->background_pressure = 1e6;
  const test::OracleParticles particles = pairAt({0.0, 0.0, 0.0}, {0.001, 0.0, 0.0});
  const PassRig<double> rig{description, SimdTarget::scalar, particles};
  const Vec3 difference = rig.acceleration()[0] - rig.acceleration()[1];
  const Vec3 closing = particles.velocity[0] - particles.velocity[1];
  if (!pushesAt(test::kSpacing)) {
    EXPECT_EQ(difference.norm(), 0.0);
  } else if (GetParam().viscosity == ViscosityTerm::none) {
    EXPECT_LT(difference.x(), 0.0) << "pressure must drive the particles apart";
    EXPECT_EQ(difference.y(), 0.0);
    EXPECT_EQ(difference.z(), 0.0);
  } else if (!pressure) {
    EXPECT_LT(difference.dot(closing), 0.0) << "viscosity must take energy";
    EXPECT_LT(difference.cross(closing).norm(), 1e-12 * difference.norm() * closing.norm());
  } else {
    EXPECT_LT(difference.dot(Vec3{0.0, closing.y(), closing.z()}), 0.0);
  }
}

TEST_P(PairLaw, MomentumSumIsZero) {
  for (const WorldDescription& base : {test::freeBlock({10, 10, 10}, 0.3), test::periodicBox({10, 9, 8}, 0.3)}) {
    const WorldDescription description = scene(base);
    for (const SimdTarget target : availableSimdTargets()) {
      const PassRig<float> rig{description, target, stirred(description)};
      Vec3 sum = Vec3::Zero();
      double magnitudes = 0.0;
      for (const Vec3& a : rig.acceleration()) {
        sum += a;
        magnitudes += a.norm();
      }
      if (pushesAt(0.8 * test::kSpacing)) { ASSERT_GT(magnitudes, 1.0); }
      EXPECT_LE(sum.norm(), 1e-6 * magnitudes) << simdTargetName(target);
    }
  }
}

TEST_P(PairLaw, CoincidentParticlesAreFinite) {
  const WorldDescription description = scene(test::freeBlock({3, 3, 3}));
  test::OracleParticles particles = stirred(description);
  for (std::size_t i = 0; i < 9; ++i) {
    particles.position[i] = particles.position[0];
    particles.radius[i] = particles.radius[0];
  }
  particles.position[10] = particles.position[9] + Vec3{1e-12, 0.0, 0.0};
  for (const SimdTarget target : availableSimdTargets()) {
    const PassRig<float> rig{description, target, particles};
    for (std::size_t i = 0; i < particles.position.size(); ++i) {
      EXPECT_TRUE(rig.acceleration()[i].allFinite()) << simdTargetName(target) << " particle " << i;
      EXPECT_TRUE(std::isfinite(rig.density()[i]));
    }
    EXPECT_NEAR(rig.density()[1], rig.density()[0], 1e-5 * rig.density()[0]);
  }
}

TEST_P(PairLaw, ForcesVanishAtTheSupport) {
  WorldDescription description = scene(test::freeBlock({2, 1, 1}));
  if (description.effects.pressure) description.effects.pressure->background_pressure = 1e6;
  for (const SimdTarget target : availableSimdTargets()) {
    const auto acceleration_at = [&](double distance) {
      const PassRig<float> rig{description, target, pairAt({0.001, 0.0, 0.0}, {0.001 + distance, 0.0, 0.0})};
      return rig.acceleration()[0].norm();
    };
    const double support = (GetParam().core_radius ? 1.2 : 1.0) * description.supportRadius();
    EXPECT_EQ(acceleration_at(1.00005 * support), 0.0);
    if (!pushesAt(0.995 * support)) continue;
    EXPECT_LT(acceleration_at(0.995 * support), 1e-4 * acceleration_at(0.001));
    EXPECT_GT(acceleration_at(0.995 * support), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(AllSets, PairLaw, testing::ValuesIn(allPairSets()));

}  // namespace
}  // namespace bleedsim::sph
