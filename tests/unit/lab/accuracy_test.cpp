// Error against time: which settings, in which order, within which time, and what is made of the measurements.
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "service/lab/accuracy/chapter.h"
#include "service/lab/accuracy/report.h"
#include "service/lab/case_names.h"
#include "service/lab/choose/error_model.h"

namespace bleedsim::lab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<const ValidationCase*> twoCases() { return {findCase("poiseuille"), findCase("incline")}; }

TEST(Settings, MoveOneKnobAtATimeFromTheBase) {
  const Knobs base;
  for (const Setting& setting : settingsOf(twoCases(), knobNames())) {
    const Knobs& knobs = setting.knobs;
    const int moved = int(knobs.across != base.across) + int(knobs.support_ratio != base.support_ratio) +
                      int(knobs.mach_factor != base.mach_factor) + int(knobs.cfl != base.cfl) +
                      int(knobs.precision != base.precision) + int(knobs.threads != base.threads);
    EXPECT_EQ(moved, setting.knob == "base" ? 0 : 1) << setting.knob;
    EXPECT_FALSE(knobs.beside) << "what is only reported is not timed";
  }
}

TEST(Settings, BeginWithWhatTellsTheCostOfTheOthers) {
  const std::vector<Setting> settings = settingsOf(twoCases(), knobNames());
  ASSERT_GE(settings.size(), 4u);
  EXPECT_LT(settings[0].knobs.across, Knobs{}.across);
  EXPECT_NE(settings[0].which, settings[1].which);
  EXPECT_EQ(settings[2].knob, "base");
  EXPECT_EQ(settings[3].knob, "base");
}

TEST(Settings, HaveThreeLevelsOfSpacingAndOnlyTheKnobsAskedFor) {
  std::set<int> levels;
  for (const Setting& setting : settingsOf({findCase("incline")}, {"spacing"})) {
    EXPECT_TRUE(setting.knob == "spacing" || setting.knob == "base") << setting.knob;
    levels.insert(setting.knobs.across);
  }
  EXPECT_GE(levels.size(), 3u);
  EXPECT_TRUE(settingsOf({findCase("free_fall")}, knobNames()).empty()) << "it has no figure to judge by";
}

// physics.md section 7 names the errors: pressure slope, mean and max compression, Poiseuille and Couette L2, Taylor-Green rate,
// drop period, volume, energy.
TEST(AccuracyCases, AreThoseWhoseErrorsTheDesignNames) {
  std::set<std::string> figures;
  const auto cases = casesOf(accuracyCaseNames());
  ASSERT_TRUE(cases.ok()) << cases.status().message();
  for (const ValidationCase* one : *cases) {
    for (const std::string_view figure : errorFiguresOf(*one)) figures.insert(fmt::format("{} {}", one->name, figure));
  }
  for (const char* named : {"hydrostatic pressure_slope", "hydrostatic compression", "hydrostatic mean_compression",
                            "poiseuille l2_steady", "couette l2_at_0_0225_s", "taylor_green decay_rate", "drop_period period",
                            "orifice_law volume_at_10_mmhg_cd_0_61", "inviscid_box periodic_energy"})
    EXPECT_EQ(figures.count(named), 1u) << named;
}

TEST(Settings, ComeInRoundsThatHoldEveryCaseAndEveryKnob) {
  int before = 0;
  std::set<std::string> first_values;
  for (const Setting& setting : settingsOf(twoCases(), knobNames())) {
    EXPECT_GE(setting.round, before);
    before = setting.round;
    if (setting.round == 2) first_values.insert(setting.knob);
  }
  EXPECT_EQ(first_values.size(), knobNames().size());
}

TEST(Estimate, GrowsWithParticlesStepsAndNeighbours) {
  const ValidationCase& incline = *findCase("incline");
  const Knobs base;
  EXPECT_DOUBLE_EQ(estimateSeconds(incline, base, 2.0, base), 2.0);
  Knobs finer = base;
  finer.across = 40;
  EXPECT_DOUBLE_EQ(estimateSeconds(incline, base, 2.0, finer), 8.0) << "twice the rows, twice the steps";
  EXPECT_DOUBLE_EQ(estimateSeconds(*findCase("drop_period"), base, 2.0, finer), 32.0);
  Knobs shorter = base;
  shorter.cfl = 0.1;
  EXPECT_NEAR(estimateSeconds(incline, base, 2.0, shorter), 8.0, 1e-12);
  Knobs stiffer = base;
  stiffer.mach_factor = 20.0;
  EXPECT_DOUBLE_EQ(estimateSeconds(incline, base, 2.0, stiffer), 4.0);
  Knobs twice = base;
  twice.precision = sph::Precision::float64;
  const double slow = estimateSeconds(incline, base, 2.0, twice);
  EXPECT_GT(slow, 4.0);
  EXPECT_DOUBLE_EQ(estimateSeconds(incline, twice, slow, base), 2.0);
}

TEST(TimeBudget, RefusesWhatDoesNotFit) {
  TimeBudget budget{10.0};
  EXPECT_TRUE(budget.fits(10.0));
  budget.spend(4.0);
  EXPECT_TRUE(budget.fits(6.0));
  EXPECT_FALSE(budget.fits(6.1));
  EXPECT_FALSE(budget.fits(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Spread, IsMedianLowestAndHighest) {
  const Spread odd = spreadOf({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.low, 1.0);
  EXPECT_EQ(odd.high, 3.0);
  EXPECT_EQ(spreadOf({1.0, 4.0}).median, 2.5);
  EXPECT_EQ(spreadOf({}).high, 0.0);
}

TEST(ParetoFront, HoldsWhatNothingElseBeats) {
  //                          cheap  dominated  better  as dear, worse  best
  EXPECT_THAT(paretoFront({1.0, 2.0, 2.0, 3.0, 5.0}, {0.5, 0.6, 0.2, 0.3, 0.1}), ElementsAre(0u, 2u, 4u));
  EXPECT_THAT(paretoFront({1.0, 1.0}, {0.2, 0.1}), ElementsAre(1u));
  EXPECT_TRUE(paretoFront({}, {}).empty());
}

TEST(ConvergenceOrder, IsThePowerOfTheError) {
  const auto order = convergenceOrder({10.0, 20.0, 40.0}, {0.08, 0.02, 0.005});
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(*order, 2.0, 1e-12);
  EXPECT_FALSE(convergenceOrder({10.0}, {0.1}).has_value());
  EXPECT_FALSE(convergenceOrder({10.0, 10.0}, {0.1, 0.2}).has_value()) << "one spacing says nothing";
  EXPECT_FALSE(convergenceOrder({10.0, 20.0}, {0.1, 0.0}).has_value()) << "an error of 0 has no logarithm";
}

Measurement measured(const char* knob, double value, std::optional<double> reference, double error) {
  Measurement one;
  one.setting = {findCase("poiseuille"), knob, {}};
  one.figures = {{"l2_steady", value, reference, error, {}, {}}};
  return one;
}

TEST(SeparatedErrors, AreTheChangesFromTheBase) {
  std::vector<Measurement> all{measured("base", 1.10, 1.0, 0.10), measured("spacing", 1.02, 1.0, 0.02),
                               measured("cfl", 1.09, 1.0, 0.09), measured("mach", 1.20, 1.0, 0.20),
                               measured("mach", 1.07, 1.0, 0.07)};
  all[1].setting.knobs.across = 40;
  all[2].setting.knobs.cfl = 0.1;
  all[3].setting.knobs.mach_factor = 5.0;
  all[4].setting.knobs.mach_factor = 20.0;
  const SeparatedErrors errors = separate(all, *findCase("poiseuille"), "l2_steady");
  EXPECT_NEAR(errors.total.value(), 0.10, 1e-12);
  EXPECT_NEAR(errors.spacing.value(), 0.08, 1e-12);
  EXPECT_NEAR(errors.time_step.value(), 0.01, 1e-12);
  EXPECT_NEAR(errors.compressibility.value(), 0.03, 1e-12) << "towards the incompressible side only";
  EXPECT_FALSE(errors.precision.has_value());
  EXPECT_FALSE(errors.spacing_order.has_value()) << "two spacings give no order to trust";
  EXPECT_FALSE(separate(all, *findCase("incline"), "profile_l2").total.has_value());
}

// A budget of 0.6 s: the coarsest spacing is always begun, most others are not, and every one of them is named.
TEST(Accuracy, KeepsItsTimeAndSaysWhatWasLeftOut) {
  AccuracyOptions options;
  options.cases = {findCase("poiseuille")};
  options.knobs = knobNames();
  options.minutes = 0.01;
  options.effects = false;
  const AccuracyResults results = measureAccuracy(options, [](double) {});
  ASSERT_FALSE(results.measurements.empty());
  EXPECT_FALSE(results.left_out.empty());
  EXPECT_EQ(results.measurements.size() + results.left_out.size(), settingsOf(options.cases, options.knobs).size());
  EXPECT_EQ(results.left_out.back().reason, "no time was left");
  EXPECT_GT(results.left_out.back().needs.value(), 0.0);
  const Measurement& first = results.measurements.front();
  ASSERT_EQ(first.figures.size(), 1u);
  EXPECT_GT(first.figures[0].error, 0.0);
  EXPECT_GT(first.cpu.median, 0.0);
  EXPECT_GT(first.microseconds.median, 0.0);
  EXPECT_GT(first.particles, 0u);
  const std::string csv = csvOf(results);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<std::ptrdiff_t>(results.measurements.size() + 1));
  EXPECT_THAT(chapterOf(results),
              HasSubstr("Left out of the 0.01 minutes, with what a run would have taken:\n\n- `poiseuille`: "));
}

AccuracyResults someResults() {
  AccuracyResults results;
  results.minutes = 5.0;
  Measurement one;
  one.setting = {findCase("hydrostatic"), "base", {}, 1};
  one.figures = {compared("pressure_slope", 1.01, 1.0, 0.07), residual("compression", 0.005, 0.015),
                 residual("mean_compression", 0.002, std::nullopt)};
  one.particles = 1280;
  one.runs = 3;
  one.wall = {0.5, 0.4, 0.6};
  one.microseconds = {0.25, 0.24, 0.26};
  results.measurements.push_back(one);
  one.setting.knob = "mach";
  one.setting.knobs.mach_factor = 20.0;
  one.figures[1] = residual("compression", 0.00125, 0.015);
  results.measurements.push_back(one);
  one.setting.knob = "precision";
  one.setting.knobs = {};
  one.setting.knobs.precision = sph::Precision::float64;
  results.left_out.push_back({one.setting, "no time was left", 50.0});
  one.setting.knob = "threads";
  one.setting.knobs = {};
  one.setting.knobs.threads = 2;
  results.left_out.push_back({one.setting, "it burst", {}});
  return results;
}

TEST(Chapter, HasEveryFigureAtEverySettingAndNamesWhatIsMissing) {
  const std::string chapter = chapterOf(someResults());
  EXPECT_THAT(chapter, HasSubstr("| error of | base | Mach 20 |\n|---|---|---|\n"
                                 "| `hydrostatic` pressure_slope | 1.00 % | 1.00 % |\n"
                                 "| `hydrostatic` compression | 0.50 % | 0.12 % |\n"
                                 "| `hydrostatic` mean_compression | 0.20 % | 0.20 % |\n"));
  EXPECT_THAT(chapter, HasSubstr("| `hydrostatic`, 1280 | 2 | 2 |\n| us per particle and step | 0.25 to 0.25 | 0.25 to 0.25 |"));
  EXPECT_THAT(chapter, HasSubstr("| `hydrostatic` compression | 0.50 % | - | - | 0.38 % | - | - |"));
  EXPECT_THAT(chapter, HasSubstr("- `hydrostatic`: double (50 s), 2 threads (it burst)\n"));
}

TEST(Chapter, LinksToItsPictures) {
  EXPECT_EQ(picturesOf({{"spacing", "spacing.png"}, {"work_incline", ""}}, "results/"),
            "\n![spacing](results/spacing.png)\n\nCurves: `results/work_incline.csv`\n");
}

// The times of a case's runs are independent; its figures are not.
TEST(Accuracy, RepeatsWhatItHasTimeFor) {
  AccuracyOptions options;
  options.cases = {findCase("couette")};
  options.knobs = {"support"};
  options.minutes = 30.0;  // it ends when all is done
  options.effects = false;
  const AccuracyResults results = measureAccuracy(options, [](double) {});
  EXPECT_TRUE(results.left_out.empty());
  ASSERT_EQ(results.measurements.size(), 4u) << "coarse, base and two support radii";
  for (const Measurement& one : results.measurements) {
    EXPECT_EQ(one.runs, 3);
    EXPECT_EQ(one.figures.size(), 2u);
    EXPECT_LE(one.cpu.low, one.cpu.median);
    EXPECT_LE(one.cpu.median, one.cpu.high);
  }
}

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

/// What stands between the first `from` and the next `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  if (begin == std::string::npos) return {};
  const std::size_t end = text.find(to, begin + from.size());
  return end == std::string::npos ? std::string{} : text.substr(begin + from.size(), end - begin - from.size());
}

// Nothing in the README's chapter is picked or written by hand: it is the report of the command that it names.
TEST(Chapter, InTheReadmeIsThatOfTheReport) {
  const std::filesystem::path root{SOURCE_DIR};
  const std::string block =
      between(textOf(root / "README.md"), "<!-- begin bleedlab accuracy -->\n", "<!-- end bleedlab accuracy -->\n");
  ASSERT_FALSE(block.empty());
  const std::string folder = between(block, " -o ", " ");
  const std::string report =
      between(textOf(root / folder / "accuracy.md"), "# Accuracy against time\n\n", "\n## Every setting\n");
  ASSERT_FALSE(report.empty()) << folder;
  EXPECT_THAT(block, HasSubstr(report));
  EXPECT_TRUE(std::filesystem::exists(root / folder / "accuracy.json"));
}

class ResultsFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const std::filesystem::path path = std::filesystem::path{testing::TempDir()} / "bleedsim_accuracy_results.json";
    std::ofstream{path, std::ios::binary} << text;
    return path;
  }
};

// Errors of 0.32/rows^2 at h = 2 dx, 0.16/rows^2 at 2.5 dx and 5 times that for the compression.
TEST_F(ResultsFile, GivesTheErrorModel) {
  AccuracyResults results;
  for (const int across : {8, 16, 32}) {
    Measurement one;
    one.setting = {findCase(kFlowCase), across == 16 ? "base" : "spacing", {}};
    one.setting.knobs.across = across;
    one.figures = {{"profile_l2", 0.0, {}, 0.16 / std::pow(0.5 * across, 2.0), {}, {}}};
    results.measurements.push_back(one);
    one.setting.knob = "cfl";  // not of the spacing: not to be taken
    one.figures[0].error = 1.0;
    results.measurements.push_back(one);
  }
  const auto points = readFlowPoints(write(toJson(results).dump()));
  ASSERT_TRUE(points.ok()) << points.status().message();
  EXPECT_EQ(points->size(), 3u);
  const ErrorModel model{*points, {{2.5, 0.8}}};
  EXPECT_TRUE(model.knows(2.5));
  EXPECT_FALSE(model.knows(2.0));
  EXPECT_NEAR(model.order(2.5), 2.0, 1e-9);
  const PredictedError error = model.predict(2.5, 4.0, 10.0);
  EXPECT_NEAR(error.flow, 0.01, 1e-9);
  EXPECT_NEAR(error.compression, 0.008, 1e-12);
}

TEST_F(ResultsFile, IsRefusedWithWhatIsWrong) {
  EXPECT_EQ(readFlowPoints("/nosuch.json").status().code(), StatusCode::not_found);
  const auto refusal = [&](const std::string& text) {
    const auto points = readFlowPoints(write(text));
    EXPECT_FALSE(points.ok());
    return points.ok() ? std::string{} : points.status().message();
  };
  EXPECT_THAT(refusal("not json"), HasSubstr("holds no measurements"));
  EXPECT_THAT(refusal("[]"), HasSubstr("holds no measurements"));
  EXPECT_THAT(refusal(R"({"measurements": 5})"), HasSubstr("holds no measurements"));
  EXPECT_THAT(refusal(R"({"measurements": [5, {"case": "poiseuille"}]})"), HasSubstr("no row of the case"));
  EXPECT_THAT(refusal(R"({"measurements": [{"case": 7}]})"), HasSubstr("no row of the case"));
  EXPECT_THAT(refusal(R"({"measurements": [{"case": "incline", "knob": "base"}]})"), HasSubstr("without support_ratio"));
  EXPECT_THAT(
      refusal(R"({"measurements": [{"case": "incline", "knob": "base", "support_ratio": 2, "across": 20, "error": -1}]})"),
      HasSubstr("out of range"));
}

}  // namespace
}  // namespace bleedsim::lab
