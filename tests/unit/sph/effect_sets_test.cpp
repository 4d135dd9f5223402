// Every legal set of pair effects as a whole world, what a set compiles to, and that an absent effect costs nothing.
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <set>

#include "tests/support/scenes.h"
#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

class EverySet : public testing::TestWithParam<PairSet> {};

// Momentum: each pair cancels to rounding, so the sum of n particles' changes drifts like a sum of roundings, below 1e-6 of the
// sum of m |v| (physics.md section 5 case 2).
TEST_P(EverySet, RunsAndKeepsMomentum) {
  for (const WorldDescription& base : {test::freeBlock({8, 8, 8}, 0.1), test::periodicBox({8, 8, 8}, 0.1)}) {
    WorldDescription description = withPairSet(base, GetParam());
    description.fluid_blocks.front().velocity = {0.1, -0.2, 0.05};
    ASSERT_EQ(pairSet(description), GetParam());
    const auto world = test::makeWorld(description);
    const Vec3 before = test::momentumOf(*world);
    for (int k = 0; k < 40; ++k) ASSERT_TRUE(world->step(1.0).ok());
    EXPECT_EQ(world->particleCount(), 512u);
    EXPECT_EQ(test::counterOf(*world, Counter::neighbor_overflow), 0u);
    ASSERT_EQ(test::counterOf(*world, Counter::acceleration_clamped), 0u) << "what is clamped has no counterpart";
    EXPECT_LT((test::momentumOf(*world) - before).norm(), 1e-6 * test::momentumScaleOf(*world));
    const PassTable<float>& table = *findPasses(world->simdTarget(), passChoice(description));
    EXPECT_EQ(world->runningCode().pair_forces, codeOf(table.force[GetParam().index()]));
    EXPECT_TRUE(std::isfinite(test::statsOf(*world).kinetic_energy));
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySet, testing::ValuesIn(allPairSets()),
                         [](const auto& tested) { return nameOf(tested.param); });

WorldDescription everything() {
  WorldDescription description = test::closedBox({14, 13, 12}, 0.2);
  EffectSettings& effects = description.effects;
  effects.gravity.emplace();
  effects.platelets.emplace();
  effects.core_radius.emplace();
  effects.repulsion.emplace();
  effects.applied_force.emplace();
  description.fluid_blocks.front().velocity = {0.1, 0.2, -0.1};
  return description;
}

TEST(EffectSets, ThreadsDoNotChangeABitWithEverythingOn) {
  for (const PressureForm form : {PressureForm::variational, PressureForm::symmetric}) {
    WorldDescription description = everything();
    description.effects.pressure->form = form;
    const auto one = test::makeWorld(description, {.threads = 1});
    const auto two = test::makeWorld(description, {.threads = 2});
    ASSERT_GT(one->particleCount(), 2000u) << "too few particles for a second thread";
    for (int k = 0; k < 15; ++k) {
      ASSERT_TRUE(one->step(1.0).ok());
      ASSERT_TRUE(two->step(1.0).ok());
      ASSERT_EQ(one->stateHash(), two->stateHash()) << "step " << k;
    }
  }
}

TEST(EffectSets, AbsentEffectsHaveNoArraysAndNoPassOfTheirOwn) {
  const WorldDescription plain = test::freeBlock({4, 4, 4});
  const auto fields = particleFields<float>(plain);
  const Particles<float> particles{plain.capacity, fields, 0};
  EXPECT_TRUE(particles.inverse_viscosity.empty());
  EXPECT_TRUE(particles.platelet.empty());
  EXPECT_TRUE(particles.radius.empty());
  EXPECT_EQ(recordGroups(pairSet(plain)), 2);
  EXPECT_FALSE(latticeFactors<float>(plain).has_value());

  WorldDescription with = plain;
  with.effects.core_radius.emplace();
  EXPECT_FALSE((Particles<float>{with.capacity, particleFields<float>(with), 0}.radius.empty()));
  EXPECT_LT(test::makeWorld(plain)->memory().particles, test::makeWorld(with)->memory().particles);
  for (const SimdTarget target : availableSimdTargets()) {
    const PassTable<float>& table = *findPasses(target, passChoice(plain));
    const auto pass = table.force[pairSet(plain).index()];
    ASSERT_NE(pass, nullptr);
    EXPECT_EQ(pass, table.force[(PairSet{PressureTerm::variational, ViscosityTerm::uniform}).index()]);
    EXPECT_NE(pass, table.force[pairSet(with).index()]);
    EXPECT_NE(table.density[0][0], table.density[0][1]);
  }
}

/// Instantiations of a table; every one must be a pass of its own.
template <class Real>
std::size_t instantiations(const PassTable<Real>& table) {
  std::set<ForceFunction<Real>> passes;
  std::size_t count = 0;
  for (const ForceFunction<Real> pass : table.force) {
    if (pass == nullptr) continue;
    passes.insert(pass);
    ++count;
  }
  EXPECT_EQ(passes.size(), count);
  EXPECT_LE(count, 128u);
  for (const auto& of_tissue : table.density)
    for (const DensityFunction<Real> pass : of_tissue) count += pass != nullptr ? 1 : 0;
  return count;
}

// architecture.md: at most 128 sets for each kernel and precision, the cubic spline with pressure and viscosity alone.
TEST(EffectSets, InstantiationsStayWithinTheirBound) {
  std::size_t total = 0;
  for (const bool periodic : {false, true}) {
    for (const KernelType kernel : {KernelType::wendland_c2, KernelType::cubic_spline}) {
      const PassChoice choice{kernel, periodic};
      std::size_t expected = 2;  // density passes, without tissue and with
      for (const PairSet& set : allPairSets()) {
        const bool plain = !set.tension && !set.repulsion && !set.core_radius;
        expected += kernel == KernelType::wendland_c2 || plain ? 1 : 0;
      }
      if (kernel == KernelType::wendland_c2) expected += 2;
      EXPECT_EQ(instantiations(referencePasses(choice)), expected);
      total += expected;
      for (const SimdTarget target : availableSimdTargets()) {
        EXPECT_EQ(instantiations(*findPasses(target, choice)), expected) << simdTargetName(target);
        total += expected;
      }
    }
  }
  std::cout << total << " pass instantiations in all\n";
  RecordProperty("instantiations", std::to_string(total));
}

}  // namespace
}  // namespace bleedsim::sph
