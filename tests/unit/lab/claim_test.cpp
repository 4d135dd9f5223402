// When a number speaks for the paper, against it, or not at all.
#include "service/lab/paper/claim.h"

#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::lab {
namespace {

constexpr Measured kHundred{100.0, 1.0};

TEST(Judge, ACountingDifferenceOfTheClaimedSignHolds) {
  EXPECT_EQ(judge(kHundred, {110.0, 1.0}, Direction::larger), Verdict::holds);
  EXPECT_EQ(judge(kHundred, {90.0, 1.0}, Direction::smaller), Verdict::holds);
}

TEST(Judge, ACountingDifferenceOfTheOtherSignDoesNot) {
  EXPECT_EQ(judge(kHundred, {90.0, 1.0}, Direction::larger), Verdict::does_not);
  EXPECT_EQ(judge(kHundred, {110.0, 1.0}, Direction::smaller), Verdict::does_not);
}

// The threshold is the larger of 5 % and twice the joint scatter.
TEST(Judge, WithinFivePerCentOrTheScatterItDepends) {
  EXPECT_EQ(judge(kHundred, {104.9, 0.0}, Direction::larger), Verdict::depends);
  EXPECT_EQ(judge(kHundred, {105.1, 0.0}, Direction::larger), Verdict::holds);
  EXPECT_EQ(judge({100.0, 3.0}, {109.9, 4.0}, Direction::larger), Verdict::depends);
  EXPECT_EQ(judge({100.0, 3.0}, {110.1, 4.0}, Direction::larger), Verdict::holds);
}

TEST(Judge, WhatChangesNothingDoesNotHold) {
  EXPECT_EQ(judge(kHundred, kHundred, Direction::larger), Verdict::does_not);
  EXPECT_EQ(judge(kHundred, {100.0 + 1e-12, 1.0}, Direction::larger), Verdict::does_not) << "rounding is no chance";
  EXPECT_EQ(judge(kHundred, {100.0 + 1e-3, 1.0}, Direction::larger), Verdict::depends);
}

TEST(Judge, EqualIsWithinTenPerCentOrTheScatter) {
  EXPECT_EQ(judge({-1.0, 0.0}, {-1.09, 0.0}, Direction::equal), Verdict::holds);
  EXPECT_EQ(judge({-1.0, 0.0}, {-1.11, 0.0}, Direction::equal), Verdict::does_not);
  EXPECT_EQ(judge({-1.0, 0.1}, {-1.19, 0.0}, Direction::equal), Verdict::holds);
}

TEST(Combine, DependsUnlessAllAgree) {
  using V = Verdict;
  const auto combined = [](std::initializer_list<V> verdicts) { return combine(std::vector<V>{verdicts}); };
  EXPECT_EQ(combined({V::holds, V::holds}), V::holds);
  EXPECT_EQ(combined({V::does_not, V::does_not}), V::does_not);
  EXPECT_EQ(combined({V::holds, V::does_not}), V::depends);
  EXPECT_EQ(combined({V::holds, V::depends}), V::depends);
  EXPECT_EQ(combined({}), V::depends);
}

TEST(Claim, AModelWithoutFiguresHasNoVoice) {
  Claim claim;
  claim.evidence.push_back(compare("sound", kHundred, Measured{120.0, 1.0}, Direction::larger));
  claim.evidence.push_back(compare("literal", kHundred, std::nullopt, Direction::larger));
  claim.evidence.push_back(
      compare("broken", kHundred, Measured{std::numeric_limits<double>::quiet_NaN(), 0.0}, Direction::larger));
  conclude(claim);
  EXPECT_EQ(claim.verdict, Verdict::holds);
}

TEST(Claim, IsWrittenWithItsNumbers) {
  Claim claim{.sentence = "it is so",
              .figure = "length mm",
              .with = "(f)",
              .without = "(a)",
              .claimed = Direction::larger,
              .evidence = {compare("sound", kHundred, Measured{120.0, 1.0}, Direction::larger),
                           compare("literal", std::nullopt, kHundred, Direction::larger)},
              .verdict = Verdict::depends};
  conclude(claim);
  const nlohmann::json json = toJson(claim);
  EXPECT_EQ(json["verdict"], "holds");
  EXPECT_EQ(json["claimed"], "larger");
  EXPECT_EQ(json["evidence"][0]["without"]["value"], 120.0);
  EXPECT_TRUE(json["evidence"][1]["with"].is_null());
  EXPECT_TRUE(json["evidence"][1]["verdict"].is_null());
  EXPECT_NE(toText(claim).find("(f) 100"), std::string::npos);
}

}  // namespace
}  // namespace bleedsim::lab
