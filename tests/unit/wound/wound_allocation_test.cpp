#include <algorithm>
#include <gtest/gtest.h>

#include "service/sph/wound/wound_set.h"
#include "tests/support/counting_new.h"
#include "tests/unit/wound/throat_world.h"

namespace bleedsim::sph {
namespace {

TEST(WoundSet, AStepAllocatesNothing) {
  WoundSet set{plainDescription(), 5.0};
  ASSERT_TRUE(set.add(discWound(0.004, 8e-6)).ok());
  std::uint32_t last = 0;
  std::uint64_t placed = 0;
  double open = 0.0;
  double highest = -1.0;
  const std::uint64_t before = test::allocationCount();
  for (int step = 0; step < 500; ++step) {
    set.advance(1e-4, [&](const InletSpawn& spawn) {
      last = spawn.tag;
      ++placed;
      return placed % 7 != 0;
    });
    highest = std::max(highest, set.kinematics(last).position.z());
    open += set.openFraction({0.001, 0.0, 0.0});
  }
  EXPECT_EQ(test::allocationCount(), before);
  EXPECT_GT(placed, 300u);
  EXPECT_GT(open / 500.0, 0.25) << "the wound is open";
  EXPECT_LT(open / 500.0, 0.95) << "but not where refusals left holes";
  EXPECT_LT(highest, 0.0) << "new particles enter behind the patch";
  EXPECT_GT(set.refusedParticles(), 10u);
  WoundDescription another = discWound(0.002, 0.0);
  another.position.x() = 0.02;
  ASSERT_TRUE(set.add(another).ok());
  EXPECT_GT(test::allocationCount(), before) << "the counter does not count";
}

}  // namespace
}  // namespace bleedsim::sph
