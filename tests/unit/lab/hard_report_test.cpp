// The table and the JSON of the hard cases.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "service/lab/hardcases/report.h"

namespace bleedsim::lab {
namespace {

constexpr HardCase kCase{7, "a_case", "what it asks", nullptr};

std::vector<CaseReport> reportOf(const std::vector<HardFigure>& figures) {
  HardOutcome outcome;
  outcome.figures = figures;
  return {CaseReport{&kCase, {CaseSetup{}}, {outcome}}};
}

Machine someMachine() { return {"Some processor", 2, "avx512", "1.0", "2026-11-26", 0.3}; }

TEST(HardReport, showsAJudgedFigureBeforeOneThatIsTold) {
  const std::string table =
      toMarkdown(reportOf({{"commands", 51.0, 0.0, 0.0, false}, {"accepted", 0.0, 0.0, 0.0, true}}), someMachine());
  EXPECT_THAT(table, testing::HasSubstr("holds: accepted 0 (exactly 0)"));
  EXPECT_THAT(table, testing::Not(testing::HasSubstr("commands")));
}

TEST(HardReport, showsTheFigureNearestToItsBound) {
  const std::string table = toMarkdown(reportOf({{"exact", 3.0, 3.0, 3.0, true},
                                                 {"near", 0.9, 0.0, 1.0, true},
                                                 {"told", 5.0, 0.0, 0.0, false},
                                                 {"far", 0.1, 0.0, 1.0, true}}),
                                       someMachine());
  EXPECT_THAT(table, testing::HasSubstr("holds: near 0.9 (0 to 1)"));
}

TEST(HardReport, showsWhatIsToldWhereNothingIsJudged) {
  EXPECT_THAT(toMarkdown(reportOf({{"told", 5.0, 0.0, 0.0, false}}), someMachine()), testing::HasSubstr("holds: told 5 |"));
}

TEST(HardReport, namesTheMachineAndTheDate) {
  const Machine machine = someMachine();
  const std::vector<CaseReport> reports = reportOf({{"far", 0.1, 0.0, 1.0, true}});
  EXPECT_THAT(toMarkdown(reports, machine), testing::StartsWith(lineOf(machine) + ".\n\n| |"));
  const nlohmann::json json = toJson(reports, machine);
  EXPECT_TRUE(json.at("machine") == toJson(machine)) << json.dump();
  EXPECT_EQ(json.at("machine").at("date").get<std::string>(), "2026-11-26");
  ASSERT_EQ(json.at("cases").size(), 1u);
  const nlohmann::json& entry = json.at("cases").at(0);
  EXPECT_EQ(entry.at("name").get<std::string>(), "a_case");
  EXPECT_EQ(entry.at("runs").at(0).at("figures").at(0).at("at_most").get<double>(), 1.0);
}

}  // namespace
}  // namespace bleedsim::lab
