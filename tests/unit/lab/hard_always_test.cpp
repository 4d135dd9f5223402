// What must always hold: a clamp that a world keeps to itself is found.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

#include "service/lab/hardcases/always.h"
#include "service/lab/hardcases/case_scene.h"
#include "tests/support/forwarding_world.h"

namespace bleedsim::lab {
namespace {

/// A world that counts clamped speeds up to a number only.
class ForgetfulWorld : public test::ForwardingWorld {
 public:
  ForgetfulWorld(std::unique_ptr<sph::World> real, std::uint64_t most) : ForwardingWorld{std::move(real)}, most_{most} {}

  void collectStats(sph::WorldStats& stats) const override {
    ForwardingWorld::collectStats(stats);
    std::uint64_t& clamped = stats.counters[static_cast<std::size_t>(sph::Counter::speed_clamped)];
    clamped = std::min(clamped, most_);
  }

 private:
  std::uint64_t most_;
};

/// One particle is seeded at 4 c0 and clamped before the first step, the other one is pushed to the bound within some steps.
Always watchTwo(std::uint64_t clamps_counted) {
  Always always;
  sph::WorldDescription scene = weightlessScene();
  scene.effects.applied_force.emplace();
  addLoneParticle(scene, {-0.03, 0, 0}, {4.0 * sph::speedOfSound(scene), 0, 0});
  addLoneParticle(scene, {0.02, 0, 0});
  auto made = sph::createWorld(scene, {});
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made.ok()) return always;
  ForgetfulWorld world{std::move(*made), clamps_counted};
  AlwaysWatch watch{world, always};
  EXPECT_TRUE(world.apply(push({0.02, 0, 0}, 0.004, {0, 1e3, 0})).ok());
  for (int step = 0; step < 10; ++step) {
    EXPECT_TRUE(world.step(1.0).ok());
    watch.check(world);
  }
  return always;
}

TEST(Always, holdsWhereEveryClampIsCounted) {
  const Always always = watchTwo(1'000'000);
  EXPECT_TRUE(always.holds());
  EXPECT_NEAR(always.fastest, 1.0, 1e-6) << "they are at the bound, else this tells nothing";
  EXPECT_EQ(always.uncounted_clamps, 0u);
}

TEST(Always, findsALaterClampThatIsNotCounted) {
  const Always always = watchTwo(1);
  EXPECT_EQ(always.uncounted_clamps, 1u);
  EXPECT_FALSE(always.holds());
}

TEST(Always, findsAClampOfTheSeedThatIsNotCounted) { EXPECT_EQ(watchTwo(0).uncounted_clamps, 2u); }

}  // namespace
}  // namespace bleedsim::lab
