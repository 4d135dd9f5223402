// Densities with own radii (34) where all radii around a cell are h, which are weighed with one kernel in place of two.
#include <gtest/gtest.h>

#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

PairSet pressure(bool core_radius) {
  PairSet set{PressureTerm::variational, ViscosityTerm::none, false, false};
  set.core_radius = core_radius;
  return set;
}

WorldDescription box(bool core_radius, bool periodic) {
  WorldDescription description = test::periodicBox({24, 8, 8}, 0.3);
  description.domain.periodic = {periodic, periodic, periodic};
  return withPairSet(description, pressure(core_radius));
}

class RadiiAtRest : public testing::TestWithParam<SimdTarget> {};

// With bounds of h, for which the cells, and with them the order of the sums, are the same.
TEST_P(RadiiAtRest, HaveTheBitsOfOneRadiusForAll) {
  for (const bool periodic : {false, true}) {
    WorldDescription description = box(true, periodic);
    description.effects.core_radius = CoreRadiusSettings{.smallest = 1.0, .largest = 1.0};
    test::OracleParticles particles = stirred(description);
    for (double& radius : particles.radius) radius = 1.0;
    const PassRig<float> own{description, GetParam(), particles};
    const PassRig<float> common{box(false, periodic), GetParam(), particles};
    EXPECT_EQ(own.density(), common.density());
    EXPECT_EQ(own.overflowed(), 0u);
  }
}

// On one half of the box radii of their own: cells at rest, cells that are not and cells that see both kinds beside each other.
TEST_P(RadiiAtRest, EndWhereTheNextRadiusIsAnother) {
  for (const bool periodic : {false, true}) {
    const WorldDescription description = box(true, periodic);
    test::OracleParticles particles = stirred(description);
    for (std::size_t i = 0; i < particles.radius.size(); ++i) {
      if (particles.position[i].x() > 0.0) particles.radius[i] = 1.0;
    }
    const PassRig<float> rig{description, GetParam(), particles};
    const test::OracleFields oracle = test::bruteForce(description, pressure(true), rig.rounded());
    EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, RadiiAtRest, testing::ValuesIn(availableSimdTargets()),
                         [](const auto& tested) { return std::string{simdTargetName(tested.param)}; });

}  // namespace
}  // namespace bleedsim::sph
