// The twenty hard cases of physics.md section 6, run by the functions that bleedlab hardcases runs.
#include <gtest/gtest.h>
#include <iomanip>
#include <sstream>
#include <string>

#include "service/lab/hardcases/report.h"

namespace bleedsim::lab {
namespace {

struct Tested {
  const HardCase* hard_case;
  CaseSetup setup;
};

std::vector<Tested> testedCases() {
  std::vector<Tested> tested;
  for (const HardCase& hard_case : hardCases()) {
    for (const sph::Precision precision : {sph::Precision::float32, sph::Precision::float64}) {
      for (const EffectChoice effects : {EffectChoice::all, EffectChoice::needed})
        tested.push_back({&hard_case, {sph::Model::sound, precision, effects}});
      tested.push_back({&hard_case, {sph::Model::literal, precision, EffectChoice::needed}});
    }
  }
  return tested;
}

std::string nameOf(const Tested& tested) {
  const CaseSetup& setup = tested.setup;
  const std::string model = setup.model == sph::Model::literal   ? "literal"
                            : setup.effects == EffectChoice::all ? "soundAll"
                                                                 : "soundNeeded";
  std::ostringstream name;
  name << "c" << std::setfill('0') << std::setw(2) << tested.hard_case->number << "_" << tested.hard_case->name << "_" << model
       << (setup.precision == sph::Precision::float32 ? "Float" : "Double");
  return name.str();
}

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Tested& tested, std::ostream* out) { *out << nameOf(tested); }

class HardCaseTest : public testing::TestWithParam<Tested> {};

// The sound model holds every bound, whatever effects act. Of the literal model only that it ends, with figures or with a reason,
// is asked: bleedlab hardcases tells what it does.
TEST_P(HardCaseTest, holds) {
  const HardOutcome outcome = runHardCase(*GetParam().hard_case, GetParam().setup);
  std::string figures;
  for (const HardFigure& figure : outcome.figures) figures.append(figures.empty() ? "" : "; ").append(describe(figure));
  RecordProperty("figures", figures);
  EXPECT_TRUE(!outcome.figures.empty() || !outcome.stopped.empty());
  EXPECT_FALSE(outcome.always.empty());
  if (GetParam().setup.model == sph::Model::literal) {
    RecordProperty("fails", describeFailures(outcome));
    return;
  }
  EXPECT_TRUE(outcome.holds()) << describeFailures(outcome) << "\nall figures: " << figures;
}

INSTANTIATE_TEST_SUITE_P(physics, HardCaseTest, testing::ValuesIn(testedCases()),
                         [](const auto& tested) { return nameOf(tested.param); });

TEST(HardCases, areTwentyNumberedFromOne) {
  ASSERT_EQ(hardCases().size(), 20u);
  for (std::size_t k = 0; k < hardCases().size(); ++k) EXPECT_EQ(hardCases()[k].number, static_cast<int>(k) + 1);
}

}  // namespace
}  // namespace bleedsim::lab
