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

PowerFit exponentOf(double exponent, std::optional<double> error, double r2 = 0.99) {
  return {.exponent = exponent, .factor = 1.0, .r2 = r2, .exponent_error = error};
}

// The bound is -1 +- 0.1, the error counts twice.
TEST(InverseVerdict, TakesTheErrorIntoAccount) {
  EXPECT_EQ(inverseVerdict(exponentOf(-0.95, 0.02)), Verdict::holds);
  EXPECT_EQ(inverseVerdict(exponentOf(-0.95, 0.03)), Verdict::depends) << "from -1.01 to -0.89";
  EXPECT_EQ(inverseVerdict(exponentOf(-1.2, 0.04)), Verdict::does_not);
  EXPECT_EQ(inverseVerdict(exponentOf(-1.2, 0.06)), Verdict::depends) << "from -1.32 to -1.08";
  EXPECT_EQ(inverseVerdict(exponentOf(-1.0, 0.01, 0.9)), Verdict::depends) << "no line";
  EXPECT_EQ(inverseVerdict(exponentOf(-1.0, std::nullopt)), Verdict::depends) << "two counts";
}

TEST(RateClaims, CarryTheScatterOfTheRates) {
  RateTable table;
  table.rows.resize(1);
  table.rows.front().particles = 22000;
  table.rows.front().rate = 21.5;
  table.rows.front().scatter = 1.0;
  table.fits = {{.search = Search::mesh, .ours = exponentOf(-0.95, 0.03), .paper = {}}};
  const std::vector<Claim> claims = rateClaims(table);
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_EQ(claims[0].verdict, Verdict::depends);
  EXPECT_DOUBLE_EQ(claims[0].evidence.front().without->scatter, 0.03);
  EXPECT_EQ(claims[1].verdict, Verdict::depends) << "1.5 above 20 is within twice the scatter";
  table.rows.front().scatter = 0.1;
  EXPECT_EQ(rateClaims(table)[1].verdict, Verdict::holds);
}

// Two discs of radius r, r apart, share 2 r^2 (pi/3 - sqrt(3)/4). A raster of r/16 has the circle's edge to half a cell: 2 %.
TEST(SharedArea, IsWhatDiscsOfTheTwoBodiesShare) {
  const std::vector<float> apart{0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
  EXPECT_EQ(sharedArea(apart, 1, 0.45), 0.0);
  const double shared = 2.0 * (std::numbers::pi / 3.0 - std::sqrt(3.0) / 4.0);
  EXPECT_NEAR(sharedArea(apart, 1, 1.0), shared, 0.02 * shared);
  EXPECT_EQ(sharedArea(apart, 2, 1.0), 0.0) << "both are the block's: what a body shares with itself does not count";
  const std::vector<float> twice{0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
  EXPECT_NEAR(sharedArea(twice, 2, 1.0), shared, 0.02 * shared) << "covered by two of the block counts once";
  EXPECT_EQ(sharedArea({}, 0, 1.0), 0.0);
}

// Two spacings long and one before the block at 2 m/s: the front is there after 0.5 s, the tail leaves after (1 + 2 + 4)/2 s.
TEST(PassageOf, IsFromTheFrontsArrivalToTheTailsLeave) {
  sph::WorldDescription scene;
  scene.fluid_blocks.resize(2);
  scene.fluid_blocks[0].lower = {0.0, 0.0, 0.0};
  scene.fluid_blocks[0].upper = {4.0, 4.0, 1.0};
  scene.fluid_blocks[1].lower = {-3.0, 1.0, 0.0};
  scene.fluid_blocks[1].upper = {-1.0, 2.0, 1.0};
  scene.fluid_blocks[1].velocity = {2.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(passageOf(scene).enter, 0.5);
  EXPECT_DOUBLE_EQ(passageOf(scene).leave, 3.5);
  scene.fluid_blocks[1].velocity = {-2.0, 0.0, 0.0};
  EXPECT_EQ(passageOf(scene).leave, 0.0) << "away from it";
  scene.fluid_blocks[1].velocity = {2.0, 0.0, 0.0};
  scene.fluid_blocks[1].lower.y() = 5.0;
  scene.fluid_blocks[1].upper.y() = 6.0;
  EXPECT_EQ(passageOf(scene).leave, 0.0) << "past it";
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

// A uniform P makes (26) a constant: whatever the figures say by chance, the platelets did nothing.
TEST(JudgeFig5, PlateletsThatStayUniformHaveNoEffect) {
  std::vector<Fig5Run> runs{runWith('c', 2.0), runWith('f', 1.0)};
  const auto of_platelets = [](const Claim& claim) { return claim.without == "(c)"; };
  runs[1].platelet_change = 0.5;
  for (const Claim& claim : judgeFig5(runs)) {
    if (of_platelets(claim)) { EXPECT_EQ(claim.verdict, Verdict::holds) << claim.sentence; }
  }
  runs[1].platelet_change = 1e-7;
  int judged = 0;
  for (const Claim& claim : judgeFig5(runs)) {
    if (!of_platelets(claim)) continue;
    ++judged;
    EXPECT_EQ(claim.verdict, Verdict::does_not) << claim.sentence;
    EXPECT_NE(claim.evidence.front().note.find("no effect"), std::string::npos);
  }
  EXPECT_EQ(judged, 3);
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
  const Claim claim = edgeErrorClaim(2.0);
  ASSERT_EQ(claim.evidence.size(), 2u);
  for (const Evidence& evidence : claim.evidence) {
    EXPECT_LT(evidence.without->value, evidence.with->value) << evidence.model;
    EXPECT_LT(evidence.with->value, 1.0) << "an error of 1 would be no force at all";
  }
}

}  // namespace
}  // namespace bleedsim::lab
