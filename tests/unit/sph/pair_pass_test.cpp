// Density and pair accelerations of every compiled pass against the brute-force oracle in double precision.
#include <gtest/gtest.h>
#include <span>
#include <tuple>
#include <utility>

#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

using test::bruteForce;
using test::OracleFields;

std::string nameOf(const std::array<bool, 3>& periodic) {
  std::string name;
  for (std::size_t a = 0; a < 3; ++a) name += periodic[a] ? std::string{"XYZ"}.substr(a, 1) : "";
  return name.empty() ? "Open" : "Periodic" + name;
}

/// 9 x 8 x 7 stirred particles; sides of 4.5, 4 and 3.5 support radii wrap where `periodic` says so. With radii of up to 1.3 h a
/// layer more: three of them must fit. Platelets diffuse where viscosity differs between particles, as it does with them.
WorldDescription scene(PairSet set, const std::array<bool, 3>& periodic) {
  WorldDescription description = withPairSet(test::periodicBox({9, 8, set.core_radius ? 8 : 7}, 0.3), set);
  description.domain.periodic = periodic;
  if (set.viscosity == ViscosityTerm::harmonic) description.effects.platelets.emplace();
  return description;
}

void expectRates(std::span<const double> rates, std::span<const double> expected, bool platelets, double tolerance) {
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    largest = std::max(largest, std::abs(expected[i]));
    difference = std::max(difference, std::abs(rates[i] - expected[i]));
  }
  if (platelets) { ASSERT_GT(largest, 1e-5) << "platelets are at rest: nothing is compared"; }
  EXPECT_LE(difference, tolerance * largest);
}

using Case = std::tuple<SimdTarget, PairSet, std::array<bool, 3>>;
class PairPass : public testing::TestWithParam<Case> {};

TEST_P(PairPass, EqualsBruteForce) {
  const auto& [target, set, periodic] = GetParam();
  const WorldDescription description = scene(set, periodic);
  const PassRig<float> rig{description, target, stirred(description)};
  const OracleFields oracle = bruteForce(description, set, rig.rounded());

  EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-5);
  const double scale = largestNorm(oracle.acceleration);
  if (PairSet{set.pressure, set.viscosity, false, set.repulsion} != PairSet{}) {
    ASSERT_GT(scale, 1.0) << "the scene is at rest: nothing is compared";
  }
  EXPECT_LE(largestDifference(rig.acceleration(), oracle.acceleration), 1e-5 * scale);
  expectRates(rig.plateletRate(), oracle.platelet_rate, description.effects.platelets.has_value(), 1e-5);
  EXPECT_EQ(rig.overflowed(), 0u);
}

TEST_P(PairPass, GivesTheSameBitsForAnyNumberOfShares) {
  const auto& [target, set, periodic] = GetParam();
  const WorldDescription description = scene(set, periodic);
  const PassRig<float> one{description, target, stirred(description)};
  for (const int shares : {2, 3, 5}) {
    const PassRig<float> many{description, target, stirred(description), shares};
    EXPECT_EQ(one.density(), many.density()) << shares << " shares";
    EXPECT_EQ(one.acceleration(), many.acceleration()) << shares << " shares";
    EXPECT_EQ(one.plateletRate(), many.plateletRate()) << shares << " shares";
  }
}

INSTANTIATE_TEST_SUITE_P(All, PairPass,
                         testing::Combine(testing::ValuesIn(availableSimdTargets()), testing::ValuesIn(allPairSets()),
                                          testing::Values(std::array{false, false, false}, std::array{true, true, true},
                                                          std::array{true, false, true})),
                         [](const testing::TestParamInfo<Case>& tested) {
                           return std::string{simdTargetName(std::get<0>(tested.param))} + "_" +
                                  nameOf(std::get<1>(tested.param)) + "_" + nameOf(std::get<2>(tested.param));
                         });

class ReferencePass : public testing::TestWithParam<std::tuple<PairSet, std::array<bool, 3>>> {};

TEST_P(ReferencePass, EqualsBruteForceToRoundOff) {
  const auto& [set, periodic] = GetParam();
  const WorldDescription description = scene(set, periodic);
  const PassRig<double> rig{description, SimdTarget::scalar, stirred(description)};
  const OracleFields oracle = bruteForce(description, set, rig.rounded());
  EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-12);
  EXPECT_LE(largestDifference(rig.acceleration(), oracle.acceleration), 1e-12 * largestNorm(oracle.acceleration));
  expectRates(rig.plateletRate(), oracle.platelet_rate, description.effects.platelets.has_value(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, ReferencePass,
                         testing::Combine(testing::ValuesIn(allPairSets()),
                                          testing::Values(std::array{false, false, false}, std::array{true, true, true},
                                                          std::array{false, true, false})),
                         [](const testing::TestParamInfo<std::tuple<PairSet, std::array<bool, 3>>>& tested) {
                           return nameOf(std::get<0>(tested.param)) + "_" + nameOf(std::get<1>(tested.param));
                         });

/// 20 layers of 12 x 12: more rows than a chunk and a layer hold, also for the share of a fifth.
TEST(PairPasses, DensitiesAndForcesAtOnceGiveTheSameBits) {
  for (const PairSet set : {PairSet{PressureTerm::variational, ViscosityTerm::uniform},
                            PairSet{PressureTerm::symmetric, ViscosityTerm::harmonic, true, true, true}}) {
    WorldDescription description = withPairSet(test::periodicBox({12, 12, 20}, 0.3), set);
    description.domain.periodic = {false, false, false};
    const PassRig<float> apart{description, SimdTarget::automatic, stirred(description)};
    for (const int shares : {1, 2, 3, 5, 40}) {
      PassRig<float> at_once{description, SimdTarget::automatic, stirred(description), shares};
      at_once.runAtOnce();
      EXPECT_EQ(apart.density(), at_once.density()) << shares << " shares";
      EXPECT_EQ(apart.acceleration(), at_once.acceleration()) << shares << " shares";
      EXPECT_EQ(apart.plateletRate(), at_once.plateletRate()) << shares << " shares";
      EXPECT_EQ(at_once.overflowed(), 0u);
    }
  }
}

/// So many particles that the room of the lists is cut into stretches, and written again behind the walk.
TEST(PairPasses, ListsThatAreNotKeptGiveTheSameBits) {
  WorldDescription description =
      withPairSet(test::periodicBox({16, 16, 50}, 0.3), {PressureTerm::variational, ViscosityTerm::uniform});
  description.domain.periodic = {false, false, false};
  const PassRig<float> apart{description, SimdTarget::automatic, stirred(description)};
  for (const int shares : {1, 2, 3}) {
    PassRig<float> at_once{description, SimdTarget::automatic, stirred(description), shares};
    for (int step = 0; step < 2; ++step) at_once.runAtOnce(false);
    EXPECT_EQ(apart.density(), at_once.density()) << shares << " shares";
    EXPECT_EQ(apart.acceleration(), at_once.acceleration()) << shares << " shares";
    EXPECT_EQ(at_once.overflowed(), 0u);
  }
}

TEST(PairPasses, RepulsionOfAnyPowersEqualsBruteForce) {
  const PairSet set{PressureTerm::none, ViscosityTerm::none, false, true};
  for (const auto& [higher, lower] : {std::pair{6, 4}, std::pair{5, 2}, std::pair{2, 1}, std::pair{7, 4}, std::pair{12, 6}}) {
    WorldDescription description = scene(set, {true, true, true});
    description.effects.repulsion->power_1 = higher;
    description.effects.repulsion->power_2 = lower;
    for (const SimdTarget target : availableSimdTargets()) {
      const PassRig<float> rig{description, target, stirred(description)};
      const OracleFields oracle = bruteForce(description, set, rig.rounded());
      const double scale = largestNorm(oracle.acceleration);
      ASSERT_GT(scale, 1.0);
      EXPECT_LE(largestDifference(rig.acceleration(), oracle.acceleration), 1e-5 * scale) << higher << ", " << lower;
    }
  }
}

TEST(PairPasses, WithTheCubicSplineEqualsBruteForce) {
  for (const PressureTerm pressure : {PressureTerm::variational, PressureTerm::symmetric}) {
    const PairSet set{pressure, ViscosityTerm::harmonic};
    for (const bool periodic : {false, true}) {
      WorldDescription description = scene(set, {periodic, periodic, periodic});
      description.kernel = KernelType::cubic_spline;
      const PassRig<double> reference{description, SimdTarget::scalar, stirred(description)};
      const OracleFields oracle = bruteForce(description, set, reference.rounded());
      EXPECT_LT(largestRelativeDifference(reference.density(), oracle.density), 1e-12);
      EXPECT_LT(largestDifference(reference.acceleration(), oracle.acceleration), 1e-12 * largestNorm(oracle.acceleration));
      for (const SimdTarget target : availableSimdTargets()) {
        const PassRig<float> rig{description, target, stirred(description)};
        const OracleFields rounded = bruteForce(description, set, rig.rounded());
        EXPECT_LT(largestRelativeDifference(rig.density(), rounded.density), 1e-5);
        EXPECT_LT(largestDifference(rig.acceleration(), rounded.acceleration), 1e-5 * largestNorm(rounded.acceleration));
      }
    }
  }
}

TEST(PairPasses, WithBackgroundPressureEqualsBruteForce) {
  PairSet set{PressureTerm::variational, ViscosityTerm::none};
  WorldDescription description = scene(set, {true, true, true});
  description.effects.pressure->background_pressure = 500.0;
  const PassRig<double> rig{description, SimdTarget::scalar, stirred(description)};
  const OracleFields oracle = bruteForce(description, set, rig.rounded());
  EXPECT_LT(largestDifference(rig.acceleration(), oracle.acceleration), 1e-12 * largestNorm(oracle.acceleration));

  description.effects.pressure->background_pressure = 0.0;
  const PassRig<double> without{description, SimdTarget::scalar, stirred(description)};
  EXPECT_GT(largestDifference(rig.acceleration(), without.acceleration()), 1.0);
}

TEST(PairPasses, WithoutPairEffectsGivesZeroAccelerations) {
  WorldDescription description = scene({}, {false, false, false});
  for (const SimdTarget target : availableSimdTargets()) {
    const PassRig<float> rig{description, target, stirred(description), 2};
    EXPECT_EQ(largestNorm(rig.acceleration()), 0.0);
    EXPECT_LT(largestRelativeDifference(rig.density(), bruteForce(description, {}, rig.rounded()).density), 1e-5);
  }
}

TEST(PairPasses, SupportRatiosOfTwoAndAHalfAndThreeEqualBruteForce) {
  for (const double ratio : {1.5, 2.5, 3.0}) {
    PairSet set{PressureTerm::variational, ViscosityTerm::uniform};
    WorldDescription description = withPairSet(test::freeBlock({9, 8, 7}, 0.3), set);
    description.support_ratio = ratio;
    for (const SimdTarget target : availableSimdTargets()) {
      const PassRig<float> rig{description, target, stirred(description)};
      const OracleFields oracle = bruteForce(description, set, rig.rounded());
      EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-5) << ratio;
      EXPECT_LT(largestDifference(rig.acceleration(), oracle.acceleration), 1e-5 * largestNorm(oracle.acceleration)) << ratio;
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
