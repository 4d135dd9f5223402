// The experiments' own sums, on bodies whose figures are known.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "service/lab/paper/claims.h"
#include "service/lab/paper/fig5.h"
#include "service/lab/paper/growth.h"
#include "service/lab/paper/intruders.h"
#include "service/lab/paper/table2.h"

namespace bleedsim::lab {
namespace {

TEST(IsInverse, TakesMinusOneAndAGoodFitOnly) {
  EXPECT_TRUE(isInverse({.exponent = -0.95, .factor = 1.0, .r2 = 0.99}));
  EXPECT_FALSE(isInverse({.exponent = -1.2, .factor = 1.0, .r2 = 0.99}));
  EXPECT_FALSE(isInverse({.exponent = -1.0, .factor = 1.0, .r2 = 0.9}));
}

// Two discs of radius r, r apart, share 2 r^2 (pi/3 - sqrt(3)/4): 39.1 % of one disc, 19.6 % of the sum. Raster of r/8: 1 %.
TEST(OverlapOf, IsWhatTwoDiscsShare) {
  const std::vector<float> apart{0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
  EXPECT_EQ(overlapOf(apart, 0.45), 0.0);
  const double shared = 2.0 * (std::numbers::pi / 3.0 - std::sqrt(3.0) / 4.0);
  EXPECT_NEAR(overlapOf(apart, 1.0), shared / (2.0 * std::numbers::pi), 0.01);
  EXPECT_EQ(overlapOf({}, 1.0), 0.0);
}

TEST(RimOf, IsTheCircleOfTheBowl) {
  sph::WorldDescription scene;
  EXPECT_FALSE(rimOf(scene).has_value());
  scene.tissue.push_back({.name = "bowl", .shape = sph::BowlShape{{0.01, 0.0, 0.0}, 0.05, 0.01}});
  const auto rim = rimOf(scene);
  ASSERT_TRUE(rim.has_value());
  EXPECT_DOUBLE_EQ(rim->x, 0.01);
  EXPECT_NEAR(rim->radius, 0.03, 1e-12);  // 30^2 + 40^2 = 50^2
}

TEST(CoveredPart, OfAHalfFilledRimIsAHalf) {
  std::vector<float> positions;
  for (int x = 0; x <= 30; ++x) {
    for (int y = -30; y <= 30; ++y) positions.insert(positions.end(), {0.001f * float(x), 0.001f * float(y), 0.0f});
  }
  // The first column is drawn 0.75 mm beyond x = 0: 0.75 x 60 mm of 2827 mm^2 more than a half.
  EXPECT_NEAR(coveredPart(positions, 0.001, {.x = 0.0, .y = 0.0, .radius = 0.03}), 0.5, 0.02);
}

TEST(EffectsOf, LeaveOutWhatTheVariantLacks) {
  sph::EffectSettings all;
  all.pressure.emplace();
  all.surface_tension.emplace();
  all.platelets.emplace();
  all.core_radius.emplace();
  all.repulsion.emplace();
  for (const Fig5Variant& variant : kFig5Variants) {
    const sph::EffectSettings left = effectsOf(all, variant);
    EXPECT_TRUE(left.pressure.has_value());
    const int off = !left.surface_tension + !left.platelets + !left.core_radius + !left.repulsion;
    EXPECT_EQ(off, variant.letter == 'a' ? 4 : variant.letter == 'f' ? 0 : 1) << variant.letter;
  }
}

Fig5Run runWith(char letter, double value) {
  Fig5Run run;
  run.model = "sound";
  run.letter = letter;
  run.figures.fill({.value = value, .scatter = 0.0});
  return run;
}

TEST(JudgeFig5, ComparesEachRunWithTheWhole) {
  std::vector<Fig5Run> runs;
  for (const char letter : {'a', 'b', 'c', 'd', 'e'}) runs.push_back(runWith(letter, 2.0));
  runs.push_back(runWith('f', 1.0));
  for (const Claim& claim : judgeFig5(runs)) {
    const Verdict expected = claim.claimed == Direction::larger ? Verdict::holds : Verdict::does_not;
    EXPECT_EQ(claim.verdict, expected) << claim.sentence;
  }
  runs[5].failure = "burst";
  for (const Claim& claim : judgeFig5(runs)) EXPECT_EQ(claim.verdict, Verdict::depends) << claim.sentence;
}

// lap poly6 ~ (1 - q^2)(7 q^2 - 3) is negative for q < sqrt(3/7) = 0.6547, lap spiky ~ (1 - q)(2 - 1/q) for q < 1/2.
TEST(LaplacianClaim, FindsTheNegativeRanges) {
  const Claim claim = laplacianClaim();
  EXPECT_EQ(claim.verdict, Verdict::holds);
  ASSERT_EQ(claim.evidence.size(), 2u);
  EXPECT_NE(claim.evidence[0].note.find("0.654"), std::string::npos);
  EXPECT_NE(claim.evidence[1].note.find("0.499"), std::string::npos);
}

TEST(EdgeErrorClaim, FindsTheVariationalFormTheMoreAccurateOne) {
  const Claim claim = edgeErrorClaim();
  ASSERT_EQ(claim.evidence.size(), 2u);
  for (const Evidence& evidence : claim.evidence) {
    EXPECT_LT(evidence.without->value, evidence.with->value) << evidence.model;
    EXPECT_LT(evidence.with->value, 1.0) << "an error of 1 would be no force at all";
  }
}

}  // namespace
}  // namespace bleedsim::lab
