// Random scenes from a fixed seed, with effects that are switched while they run: what must always hold does. bleedlab torture
// runs any number of others.
#include "service/lab/torture/torture.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <string>

namespace bleedsim::lab {
namespace {

constexpr std::uint64_t kSeed = 20261126;
constexpr int kSteps = 80;
constexpr int kScenesOfAPart = 25;

struct Part {
  int ran = 0;
  std::uint64_t switched = 0;
  std::uint64_t particle_steps = 0;
};

/// The scenes of a part, from a seed on; each is refused or holds.
Part runPart(std::uint64_t first, scene::Scene::Model model) {
  std::printf("torture: seeds %llu and the %d after it\n", static_cast<unsigned long long>(first), kScenesOfAPart - 1);
  Part part;
  for (std::uint64_t seed = first; seed < first + kScenesOfAPart; ++seed) {
    const TortureOutcome outcome = runPlan(makePlan(seed, model, kSteps));
    EXPECT_TRUE(outcome.refused || outcome.holds) << "seed " << seed << ": " << outcome.text;
    part.ran += outcome.refused ? 0 : 1;
    part.switched += outcome.switched;
    part.particle_steps += outcome.particle_steps;
  }
  return part;
}

class TortureTest : public testing::TestWithParam<int> {};

// 200 in all. A failure names its seed: bleedlab torture --seed SEED --count 1 --steps 80 makes it small.
TEST_P(TortureTest, randomScenesKeepWhatMustAlwaysHold) {
  const Part part = runPart(kSeed + static_cast<std::uint64_t>(GetParam() * kScenesOfAPart), scene::Scene::SOUND);
  EXPECT_GT(part.switched, static_cast<std::uint64_t>(kScenesOfAPart)) << "two for each scene are drawn, and most of them can be";
  EXPECT_LT(kScenesOfAPart - part.ran, kScenesOfAPart / 4) << "most scenes must be valid to be worth it";
}

// A part more with the equations as printed. They may fault, which ends a scene, and more scenes are refused: what blocks and
// effects say that the model does not read. What must always hold does until then.
TEST(Torture, literalScenesKeepWhatMustAlwaysHold) {
  const Part part = runPart(kSeed + 1000, scene::Scene::LITERAL);
  EXPECT_GE(2 * part.ran, kScenesOfAPart) << "most scenes must be valid to be worth it";
  // As many as ten particles make in each scene that runs to its end; scenes have hundreds.
  EXPECT_GT(part.particle_steps, static_cast<std::uint64_t>(10 * part.ran * kSteps)) << "scenes fault before they move";
}

INSTANTIATE_TEST_SUITE_P(parts, TortureTest, testing::Range(0, 8));

// Seeds that found something. 58: an implicit solve left a particle of a fast body above v_cap.
TEST(Torture, seedsThatOnceFailed) {
  for (const std::uint64_t seed : {58}) {
    const TortureOutcome outcome = runPlan(makePlan(seed, scene::Scene::SOUND, 120));
    EXPECT_TRUE(outcome.holds && !outcome.refused) << "seed " << seed << ": " << outcome.text;
  }
}

TEST(TorturePlan, isTheSameForTheSameSeed) {
  const std::string text = toText(makePlan(7, scene::Scene::SOUND, kSteps));
  EXPECT_EQ(text, toText(makePlan(7, scene::Scene::SOUND, kSteps)));
  EXPECT_NE(text, toText(makePlan(8, scene::Scene::SOUND, kSteps)));
}

}  // namespace
}  // namespace bleedsim::lab
