// Validation cases without the solver: the catalog, what a figure says, and the report.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "service/lab/case_names.h"
#include "service/lab/validation/case_world.h"
#include "service/lab/validation/report.h"

namespace bleedsim::lab {
namespace {

using testing::HasSubstr;

TEST(Catalog, HasTheFourteenCasesOfTheDesign) {
  std::set<int> numbers;
  std::set<std::string_view> names;
  int before = 0;
  for (const ValidationCase& one : validationCases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    if (one.number == 0) continue;
    EXPECT_GE(one.number, before) << one.name;
    before = one.number;
    numbers.insert(one.number);
  }
  EXPECT_EQ(numbers.size(), 14u);
}

TEST(Catalog, ErrorFiguresExist) {
  Knobs knobs;
  knobs.across = 8;
  knobs.beside = false;
  for (const char* name :
       {"inviscid_box", "hydrostatic", "poiseuille", "couette", "incline", "platelet_spread", "taylor_green", "orifice_law"}) {
    const ValidationCase* which = findCase(name);
    ASSERT_NE(which, nullptr) << name;
    const auto result = which->run(knobs);
    ASSERT_TRUE(result.ok()) << result.status().message();
    ASSERT_TRUE(which->measuresAccuracy()) << name;
    for (const std::string_view figure : which->error_figures) {
      if (!figure.empty()) { EXPECT_NE(result->find(figure), nullptr) << name << ' ' << figure; }
    }
    EXPECT_GT(result->cost.steps, 0u) << name;
    std::set<std::string> figures;
    for (const Figure& figure : result->figures) EXPECT_TRUE(figures.insert(figure.name).second) << figure.name;
  }
}

TEST(CaseNames, AreTakenOnceInTheirOrder) {
  const auto cases = casesOf({"incline", "poiseuille", "incline"});
  ASSERT_TRUE(cases.ok());
  EXPECT_THAT(*cases, testing::ElementsAre(findCase("poiseuille"), findCase("incline")));
  EXPECT_EQ(casesOf({})->size(), validationCases().size());
  const auto wrong = casesOf({"poiseuile"});
  ASSERT_FALSE(wrong.ok());
  EXPECT_THAT(wrong.status().message(), testing::AllOf(HasSubstr("no case 'poiseuile'"), HasSubstr("poiseuille")));
}

TEST(Figure, HoldsMissesOrIsReported) {
  EXPECT_EQ(compared("x", 1.05, 1.0, 0.07).grade(), Grade::holds);
  EXPECT_EQ(compared("x", 0.9, 1.0, 0.07).grade(), Grade::misses);
  EXPECT_EQ(compared("x", 0.9, 1.0, std::nullopt).grade(), Grade::reported);
  EXPECT_EQ(residual("x", -0.02, 0.01).grade(), Grade::misses);
  EXPECT_EQ(residual("x", std::numeric_limits<double>::quiet_NaN(), 0.01).grade(), Grade::misses);
}

TEST(Knobs, ShortenTheStepByTheirCfl) {
  Knobs knobs;
  RunCost cost;
  sph::WorldDescription scene = emptyScene(knobs, 0.001, 0.5);
  scene.effects.pressure.emplace();
  fillPeriodic(scene, {8, 8, 8}, 0.0);
  const auto dt = [&](double cfl) {
    knobs.cfl = cfl;
    auto world = CaseWorld::create(scene, knobs, cost);
    EXPECT_TRUE(world.ok());
    EXPECT_TRUE(world->step(1.0).ok());
    return world->stats().dt;
  };
  const double stable = dt(kStableCfl);
  EXPECT_NEAR(dt(0.1), 0.25 * stable, 1e-9 * stable);
}

TEST(CaseWorld, EndsExactlyAndCountsItsCostAfterTheWarmUp) {
  const Knobs knobs;
  RunCost cost;
  sph::WorldDescription scene = emptyScene(knobs, 0.001, 0.5);
  scene.effects.pressure.emplace();
  fillPeriodic(scene, {8, 8, 8}, 0.1);
  auto world = CaseWorld::create(scene, knobs, cost);
  ASSERT_TRUE(world.ok()) << world.status().message();
  ASSERT_TRUE(world->runFor(0.01).ok());
  EXPECT_NEAR((*world)->time(), 0.01, 1e-13);
  EXPECT_EQ(cost.steps, (*world)->stepCount() - kWarmUpSteps);
  EXPECT_EQ(cost.particle_steps, cost.steps * 512);
  EXPECT_GT(cost.all_wall, cost.wall);
}

// Two particles under gravity alone: what is measured is gravity, by the order in which they were placed.
TEST(Accelerations, AreThoseOfTheParticlesAsTheyStand) {
  const Knobs knobs;
  sph::WorldDescription scene = emptyScene(knobs, 0.001, 0.5);
  scene.effects.gravity.emplace().acceleration = {1.0, 2.0, -3.0};
  addParticle(scene, {0.01, 0.0, 0.0}, {0.5, 0.0, 0.0});
  addParticle(scene, {-0.01, 0.0, 0.0}, sph::Vec3::Zero());
  const auto found = accelerationsOf(scene, knobs.options(), 1e-4);
  ASSERT_TRUE(found.ok()) << found.status().message();
  ASSERT_EQ(found->size(), 2u);
  EXPECT_LT(((*found)[0] - sph::Vec3{1.0, 2.0, -3.0}).norm(), 1e-3);
  EXPECT_LT(((*found)[1] - sph::Vec3{1.0, 2.0, -3.0}).norm(), 1e-3);
}

ValidationRun someRun() {
  ValidationRun run;
  run.machine = thisMachine();
  CaseOutcome good{findCase("incline"), {}, {}};
  good.result.figures = {compared("flow", 0.9, 1.0, 0.08, "m^2/s"), residual("profile_l2", 0.01, 0.08)};
  good.result.plots.push_back({"incline", {}});
  good.result.plots.back().plot.series.push_back({"found", picture::SeriesStyle::points, {0.0, 1.0}, {1.0, 2.0}});
  run.outcomes.push_back(good);
  run.outcomes.push_back({findCase("puddle"), Status{StatusCode::internal, "it burst"}, {}});
  return run;
}

TEST(Report, TellsEveryFigureAndWhatFailed) {
  const std::string table = tableOf(someRun());
  EXPECT_THAT(table, HasSubstr("| 13 incline | flow | 0.9 m^2/s | 1 m^2/s | 10.00 % | 8.00 % | misses |"));
  EXPECT_THAT(table, HasSubstr("| 14 puddle | | | | | | could not be run: it burst |"));
  EXPECT_THAT(table,
              HasSubstr("1 figures hold their threshold, 1 miss it, 0 are reported without one. 1 cases could not be run."));
  const nlohmann::json json = toJson(someRun());
  EXPECT_EQ(json["cases"][0]["figures"][0]["grade"], "misses");
  EXPECT_EQ(json["cases"][1]["failed"], "it burst");
}

TEST(Report, NamesWhatMisses) {
  EXPECT_THAT(missesOf(someRun()),
              testing::ElementsAre("incline misses its threshold: flow is 0.9 m^2/s, off by 10.00 %; 8.00 % are allowed",
                                   "puddle could not be run: it burst"));
  ValidationRun good = someRun();
  good.outcomes.pop_back();
  good.outcomes[0].result.figures[0].error = 0.08;
  EXPECT_TRUE(missesOf(good).empty());
}

// What a case is known to fall short by stands where it does, and only there.
TEST(Report, SaysWhatAMissComesFrom) {
  ValidationRun run;
  run.machine = thisMachine();
  CaseOutcome vortices{findCase("taylor_green"), {}, {}};
  vortices.result.figures = {compared("decay_rate", 1.3, 1.0, 0.1)};
  run.outcomes.push_back(vortices);
  const std::filesystem::path folder = std::filesystem::path{testing::TempDir()} / "bleedsim_validation_shortfall";
  std::filesystem::create_directories(folder);
  const auto report = [&] {
    EXPECT_TRUE(writeReport(folder.string(), run).ok());
    std::ostringstream text;
    text << std::ifstream{folder / "report.md"}.rdbuf();
    return text.str();
  };
  const std::string why = "What misses: " + std::string{findCase("taylor_green")->shortfall};
  EXPECT_THAT(report(), HasSubstr(why));
  run.outcomes[0].result.figures[0].error = 0.05;
  EXPECT_THAT(report(), testing::Not(HasSubstr("What misses")));
  std::filesystem::remove_all(folder);
}

// A step far longer than the scene's speeds allow: gravity of 1e5 m/s^2 is cut at every particle.
TEST(CaseWorld, CountsWhatTheSolverHadToCut) {
  const Knobs knobs;
  RunCost cost;
  sph::WorldDescription scene = emptyScene(knobs, 0.001, 0.1);
  scene.effects.gravity.emplace().acceleration = {0.0, 0.0, -1e5};
  scene.domain.lower = sph::Vec3::Constant(-0.01);
  scene.domain.upper = sph::Vec3::Constant(0.01);
  addParticle(scene, sph::Vec3::Zero(), sph::Vec3::Zero());
  auto world = CaseWorld::create(scene, knobs, cost);
  ASSERT_TRUE(world.ok()) << world.status().message();
  ASSERT_TRUE(world->runFor(1e-4).ok());
  EXPECT_GE(cost.clamped, (*world)->stepCount());
  const std::uint64_t once = cost.clamped;
  ASSERT_TRUE(world->runFor(1e-5).ok());
  EXPECT_GT(cost.clamped, once);
  EXPECT_LT(cost.clamped, 2 * once) << "each is counted once";
}

TEST(Report, IsWrittenWithItsPlots) {
  const std::filesystem::path folder = std::filesystem::path{testing::TempDir()} / "bleedsim_validation_report";
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(writeReport(folder.string(), someRun()).ok());
  std::ostringstream text;
  text << std::ifstream{folder / "report.md"}.rdbuf();
  EXPECT_THAT(text.str(), testing::AllOf(HasSubstr("## incline"), HasSubstr("u = rho g sin(30) H^2/(2 mu)")));
  EXPECT_TRUE(std::filesystem::exists(folder / "incline.csv"));
  const Status refused = writeReport("/proc/nowhere", someRun());
  EXPECT_EQ(refused.code(), StatusCode::io);
}

}  // namespace
}  // namespace bleedsim::lab
