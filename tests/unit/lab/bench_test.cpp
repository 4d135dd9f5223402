// What `bleedlab bench` counts, tells and compares. Times are not judged.
#include "service/lab/bench/bench.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/lab/bench/comparison.h"
#include "service/lab/bench/report.h"
#include "service/lab/bench/still_block.h"
#include "service/scene/scene.h"

namespace bleedsim::lab {
namespace {

using testing::HasSubstr;
using testing::Not;

std::unique_ptr<sph::World> worldOf(const sph::WorldDescription& description) {
  auto world = sph::createWorld(description, {});
  EXPECT_TRUE(world.ok()) << world.status().message();
  return world.ok() ? std::move(*world) : nullptr;
}

TEST(StillBlock, IsACubeInFreeSpaceOfAboutSoManyParticles) {
  for (const std::string& name : blockModelNames()) {
    const sph::WorldDescription block = stillBlock(blockModelOf(name), 20000);
    EXPECT_EQ(block.capacity, 27u * 27u * 27u) << name;
    EXPECT_TRUE(block.tissue.empty() && block.wounds.empty()) << name;
    EXPECT_DOUBLE_EQ(block.supportRadius(), 0.002) << name;
    for (int a = 0; a < 3; ++a) {
      EXPECT_GT(block.fluid_blocks[0].lower[a] - block.domain.lower[a], 4.0 * block.supportRadius()) << name;
      EXPECT_GT(block.domain.upper[a] - block.fluid_blocks[0].upper[a], 4.0 * block.supportRadius()) << name;
    }
  }
}

TEST(StillBlock, TakesItsOwnStepAndKeepsItsShape) {
  for (const std::string& name : blockModelNames()) {
    const auto world = worldOf(stillBlock(blockModelOf(name), 1000));
    ASSERT_NE(world, nullptr) << name;
    ASSERT_EQ(world->particleCount(), 1000u) << name;
    const double before = takeCensus(*world).neighbors;
    for (int k = 0; k < 64; ++k) ASSERT_TRUE(world->step(kBlockStep).ok()) << name;
    sph::WorldStats stats;
    world->collectStats(stats);
    EXPECT_DOUBLE_EQ(stats.dt, kBlockStep) << name;
    // 0.3 m/s over 128 us are 0.04 spacings at most, where neighbours that come and go balance; (34) moves radii meanwhile.
    EXPECT_LT(stats.max_speed, 0.3) << name;
    EXPECT_NEAR(takeCensus(*world).neighbors, before, name == "full" ? 1.0 : 0.1) << name;
  }
}

TEST(StillBlock, HasTheTermsOfItsModel) {
  const sph::WorldDescription paper = stillBlock(BlockModel::paper, 1000);
  EXPECT_EQ(paper.model, sph::Model::literal);
  EXPECT_EQ(paper.literal.pressure, sph::PressureForm::variational);
  EXPECT_DOUBLE_EQ(2.0 * paper.literal.contact_radius, 0.9) << "repulsion reaches 0.9 dx";
  for (const char* effect : {"gravity", "pressure", "viscosity", "surface_tension", "platelets", "repulsion"})
    EXPECT_TRUE(sph::effectEnabled(paper, effect)) << effect;
  EXPECT_FALSE(sph::effectEnabled(paper, "core_radius"));
  const sph::WorldDescription reduced = stillBlock(BlockModel::reduced, 1000);
  EXPECT_EQ(reduced.model, sph::Model::sound);
  for (const char* effect : {"surface_tension", "platelets", "repulsion", "core_radius", "adhesion"})
    EXPECT_FALSE(sph::effectEnabled(reduced, effect)) << effect;
  const sph::WorldDescription full = stillBlock(BlockModel::full, 1000);
  EXPECT_EQ(full.model, sph::Model::sound);
  for (const char* effect : {"gravity", "pressure", "viscosity", "surface_tension", "platelets", "repulsion", "core_radius"})
    EXPECT_TRUE(sph::effectEnabled(full, effect)) << effect;
}

/// Mean neighbours, pair by pair; along periodic axes to the nearest image.
double neighborsByPairs(const sph::World& world) {
  const sph::WorldDescription& scene = world.description();
  sph::FrameBuffer frame;
  frame.reserve(scene.capacity, 0);
  world.copyFrame(frame, 0);
  double pairs = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    for (std::size_t j = 0; j < frame.count; ++j) {
      double square = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        double d = static_cast<double>(frame.position[3 * j + a]) - static_cast<double>(frame.position[3 * i + a]);
        const auto axis = static_cast<Eigen::Index>(a);
        if (scene.domain.periodic[a])
          d -= std::round(d / (scene.domain.upper[axis] - scene.domain.lower[axis])) *
               (scene.domain.upper[axis] - scene.domain.lower[axis]);
        square += d * d;
      }
      if (i != j && square < scene.supportRadius() * scene.supportRadius()) pairs += 1.0;
    }
  }
  return pairs / frame.count;
}

// Single precision may see a pair at the very edge otherwise than double.
constexpr double kEdgePairs = 0.01;

TEST(Census, CountsThePairsOfABlock) {
  const auto world = worldOf(stillBlock(BlockModel::reduced, 1000));
  ASSERT_NE(world, nullptr);
  const Census census = takeCensus(*world);
  EXPECT_EQ(census.particles, 1000u);
  EXPECT_NEAR(census.neighbors, neighborsByPairs(*world), kEdgePairs);
  EXPECT_DOUBLE_EQ(census.listed, census.neighbors + 1.0);
  EXPECT_GT(census.candidates, census.listed);
  EXPECT_EQ(census.surface, 0.0) << "no tension";
}

TEST(Census, CountsAcrossPeriodicSides) {
  sph::WorldDescription scene = stillBlock(BlockModel::reduced, 1000);
  scene.domain.lower = sph::Vec3::Zero();
  scene.domain.upper = sph::Vec3::Constant(0.01);
  scene.domain.periodic = {true, true, true};
  const auto world = worldOf(scene);
  ASSERT_NE(world, nullptr);
  EXPECT_NEAR(takeCensus(*world).neighbors, neighborsByPairs(*world), kEdgePairs);
}

TEST(Census, OfOneCellIsEveryPair) {
  sph::WorldDescription scene = stillBlock(BlockModel::full, 8);
  scene.fluid_blocks[0].jitter = 0.0;
  const auto world = worldOf(scene);
  ASSERT_NE(world, nullptr);
  const Census census = takeCensus(*world);
  EXPECT_EQ(census.particles, 8u);
  EXPECT_DOUBLE_EQ(census.neighbors, 7.0);
  EXPECT_DOUBLE_EQ(census.listed, 8.0);
  EXPECT_DOUBLE_EQ(census.candidates, 8.0);
  EXPECT_DOUBLE_EQ(census.boxed, 1.0) << "eight, for eight particles at once";
  EXPECT_DOUBLE_EQ(census.surface, 1.0) << "all are corners";
}

constexpr Census kToy{.particles = 100, .neighbors = 9.0, .listed = 10.0, .candidates = 20.0, .boxed = 2.0, .surface = 0.5};

const Work& at(const StageWork& stages, sph::Stage stage) { return stages[static_cast<std::size_t>(stage)]; }

TEST(Work, OfPressureAndViscosityByHand) {
  const sph::WorldDescription scene = stillBlock(BlockModel::reduced, 1000);
  const StageWork work = workOf(scene, kToy, 0);
  // Geometry 4, Wendland's slope 4, (16) 8, uniform viscosity 14.
  EXPECT_DOUBLE_EQ(pairFlops(scene, false), 30.0);
  EXPECT_DOUBLE_EQ(at(work, sph::Stage::force).flops, 300.0);
  // Two groups of the record, ten entries with their distances and their place, an acceleration.
  EXPECT_DOUBLE_EQ(at(work, sph::Stage::force).bytes, 32.0 + 80.0 + 5.0 + 16.0);
  // Box tests 19, distance tests 9, kernel and sum 9, equation of state 8.
  EXPECT_DOUBLE_EQ(at(work, sph::Stage::density).flops, 2.0 * 19.0 + 20.0 * 9.0 + 10.0 * 9.0 + 8.0);
  EXPECT_DOUBLE_EQ(at(work, sph::Stage::density).bytes, 12.0 + 80.0 + 5.0 + 8.0 + 4.0);
  EXPECT_EQ(at(work, sph::Stage::tissue).bytes, 0.0) << "not counted";
  Work sum;
  for (const Work& stage : work) sum += stage;
  EXPECT_DOUBLE_EQ(totalOf(work).flops, sum.flops);
  EXPECT_DOUBLE_EQ(totalOf(work).bytes, sum.bytes);
}

TEST(Work, OfThePapersPairByHand) {
  // Geometry 4, spiky 6, (16) 11, colour field 13, (25) 11, (27) 5, (36) 18 and the powers 6 and 4.
  EXPECT_DOUBLE_EQ(pairFlops(stillBlock(BlockModel::paper, 1000), false), 78.0);
}

TEST(Work, OfTheSoundModelsPlateletsIsLeftOut) {
  sph::WorldDescription scene = stillBlock(BlockModel::full, 1000);
  const Work with = totalOf(workOf(scene, kToy, 0));
  scene.effects.platelets.reset();
  EXPECT_DOUBLE_EQ(totalOf(workOf(scene, kToy, 0)).flops, with.flops);
  scene.effects.viscosity->rheology = sph::CassonRheology{};
  // Its shear rates need a sweep in every step: geometry and the slope with both radii, then the moments.
  EXPECT_DOUBLE_EQ(totalOf(workOf(scene, kToy, 0)).flops - with.flops, 10.0 * (4.0 + 14.0 + 38.0));
}

TEST(Work, OfTensionGoesWithTheSurface) {
  const sph::WorldDescription scene = stillBlock(BlockModel::full, 1000);
  Census inside = kToy;
  inside.surface = 0.0;
  Census surface = kToy;
  surface.surface = 1.0;
  const double none = at(workOf(scene, inside, 0), sph::Stage::force).flops;
  const double half = at(workOf(scene, kToy, 0), sph::Stage::force).flops;
  const double all = at(workOf(scene, surface, 0), sph::Stage::force).flops;
  EXPECT_GT(half, none);
  EXPECT_NEAR(all - half, half - none, 1e-9 * all);
}

TEST(Work, OfImplicitViscosityIsInTheSolver) {
  const sph::WorldDescription scene = stillBlock(BlockModel::reduced, 1000);
  EXPECT_DOUBLE_EQ(pairFlops(scene, true), 30.0 - 14.0);
  const double without = at(workOf(scene, kToy, 0), sph::Stage::integrate).flops;
  const double once = at(workOf(scene, kToy, 1), sph::Stage::integrate).flops;
  const double thrice = at(workOf(scene, kToy, 3), sph::Stage::integrate).flops;
  EXPECT_DOUBLE_EQ(once - without, 10.0 * (8.0 + 22.0)) << "a product: geometry and slope, then its terms";
  EXPECT_DOUBLE_EQ(thrice - without, 3.0 * (once - without));
}

TEST(Roofline, IsTheLaterOfArithmeticAndMemory) {
  const CeilingOutcome ceiling{.threads = 1, .gflops = {100.0, 90.0, 110.0}, .gigabytes_s = {20.0, 19.0, 21.0}};
  // 1000 flops take 10 ns, 100 bytes 5 ns; 1000 bytes 50 ns.
  EXPECT_NEAR(rooflineShare({1000.0, 100.0}, 0.1, ceiling), 0.1, 1e-12);
  EXPECT_NEAR(rooflineShare({1000.0, 1000.0}, 0.1, ceiling), 0.5, 1e-12);
  EXPECT_EQ(rooflineShare({}, 0.1, ceiling), 0.0);
  EXPECT_EQ(rooflineShare({1000.0, 100.0}, 0.0, ceiling), 0.0);
}

TEST(Sampled, IsTheMedianWithBothEnds) {
  const Sampled sampled = sampledOf({5.0, 1.0, 2.0});
  EXPECT_EQ(sampled.median, 2.0);
  EXPECT_EQ(sampled.least, 1.0);
  EXPECT_EQ(sampled.most, 5.0);
  EXPECT_EQ(sampledOf({}).median, 0.0);
}

BenchOutcome toyOutcome() {
  BenchOutcome outcome;
  outcome.machine = {.processor = "Toy", .cores = 2, .simd = "scalar", .version = "1", .date = "2026-01-01", .load = 0.0};
  outcome.build = "1.0-abc";
  outcome.ceilings = {{1, {100.0, 90.0, 110.0}, {20.0, 19.0, 21.0}}};
  MeasuredCase one;
  one.model = "reduced";
  one.simd = "scalar";
  one.particles = 1000;
  one.turns = 5;
  one.steps = 7;
  one.dt = kBlockStep;
  one.census = kToy;
  one.work = workOf(stillBlock(BlockModel::reduced, 1000), kToy, 0);
  one.updates = {4.0, 3.0, 5.0};
  one.microseconds = {0.25, 0.2, 0.33};
  one.stages[static_cast<std::size_t>(sph::Stage::force)] = {0.1, 0.09, 0.12};
  one.bytes = 150.0;
  one.list_bytes = 200.0;
  outcome.cases = {one};
  return outcome;
}

TEST(BenchReport, HasAFieldForEverything) {
  const nlohmann::json json = toJson(toyOutcome());
  EXPECT_EQ(json.at("build"), "1.0-abc");
  EXPECT_EQ(json.at("machine").at("processor"), "Toy");
  EXPECT_EQ(json.at("machine").at("date"), "2026-01-01");
  EXPECT_EQ(json.at("ceilings").at(0).at("fma_gflops"), 100.0);
  EXPECT_EQ(json.at("ceilings").at(0).at("triad_gb_s_least"), 19.0);
  ASSERT_EQ(json.at("cases").size(), 1u);
  const nlohmann::json& one = json.at("cases").at(0);
  EXPECT_EQ(one.at("model"), "reduced");
  EXPECT_FALSE(one.contains("scene"));
  EXPECT_EQ(one.at("particles"), 1000);
  EXPECT_EQ(one.at("threads"), 1);
  EXPECT_EQ(one.at("simd"), "scalar");
  EXPECT_EQ(one.at("m_updates_per_s"), 4.0);
  EXPECT_EQ(one.at("m_updates_per_s_least"), 3.0);
  EXPECT_EQ(one.at("m_updates_per_s_most"), 5.0);
  EXPECT_EQ(one.at("neighbors"), 9.0);
  EXPECT_EQ(one.at("memory_bytes_per_particle"), 150.0);
  EXPECT_EQ(one.at("list_bytes_per_particle"), 200.0);
  EXPECT_GT(one.at("flops_per_particle_step").get<double>(), 600.0);
  EXPECT_GT(one.at("bytes_per_particle_step").get<double>(), 200.0);
  EXPECT_DOUBLE_EQ(one.at("fma_share").get<double>(), 1e-3 * one.at("flops_per_particle_step").get<double>() / 0.25 / 100.0);
  EXPECT_GT(one.at("roofline_share").get<double>(), 0.0);
  EXPECT_EQ(one.at("stages").size(), static_cast<std::size_t>(sph::Stage::count));
  for (const nlohmann::json& stage : one.at("stages")) {
    EXPECT_TRUE(stage.contains("us"));
    EXPECT_EQ(stage.contains("flops"), stage.contains("roofline_share"));
    if (stage.at("name") != "force") continue;
    EXPECT_EQ(stage.at("us"), 0.1);
    EXPECT_EQ(stage.at("flops"), 300.0);
  }
}

TEST(BenchReport, TellsWhatThreadsGain) {
  BenchOutcome outcome = toyOutcome();
  EXPECT_FALSE(toJson(outcome).at("cases").at(0).contains("over_one_thread"));
  MeasuredCase two = outcome.cases[0];
  two.threads = 2;
  two.updates.median = 7.0;
  outcome.cases.push_back(two);
  outcome.ceilings.push_back(outcome.ceilings[0]);
  outcome.ceilings[1].threads = 2;
  EXPECT_FALSE(toJson(outcome).at("cases").at(0).contains("over_one_thread"));
  EXPECT_DOUBLE_EQ(toJson(outcome).at("cases").at(1).at("over_one_thread").get<double>(), 1.75);
  EXPECT_THAT(tablesOf(outcome), HasSubstr("1.75 times as fast as one thread"));
}

TEST(BenchReport, ShowsMedianSpreadAndStages) {
  const std::string tables = tablesOf(toyOutcome());
  EXPECT_THAT(tables, HasSubstr("reduced, 1000 particles, 1 thread"));
  EXPECT_THAT(tables, HasSubstr("4.000 million particle-updates/s (3.000 - 5.000)"));
  EXPECT_THAT(tables, HasSubstr("5 turns of 7 steps"));
  EXPECT_THAT(tables, HasSubstr("0.1000 (0.0900 - 0.1200)"));
}

TEST(Comparison, TellsHowManyTimesAsFastEachStageIs) {
  const BenchOutcome now = toyOutcome();
  BenchOutcome earlier = now;
  earlier.cases[0].updates.median = 2.0;
  earlier.cases[0].microseconds.median = 0.5;
  earlier.cases[0].stages[static_cast<std::size_t>(sph::Stage::force)].median = 0.4;
  const auto then = parseBench(toJson(earlier).dump(), "then.json");
  ASSERT_TRUE(then.ok()) << then.status().message();
  const std::string text = comparisonOf(now, *then, "then.json");
  EXPECT_THAT(text, HasSubstr("2.000 times"));
  EXPECT_THAT(text, HasSubstr("force        0.1000   0.4000   4.000"));
  EXPECT_THAT(text, HasSubstr("step         0.2500   0.5000   2.000"));
  EXPECT_THAT(text, Not(HasSubstr("another machine")));
}

TEST(Comparison, NamesAnotherMachineAndCasesWithoutATwin) {
  const BenchOutcome now = toyOutcome();
  BenchOutcome earlier = now;
  earlier.machine.processor = "Other";
  earlier.cases[0].model = "paper";
  earlier.cases[0].particles = 5000;
  const auto then = parseBench(toJson(earlier).dump(), "then.json");
  ASSERT_TRUE(then.ok()) << then.status().message();
  const std::string text = comparisonOf(now, *then, "then.json");
  EXPECT_THAT(text, HasSubstr("another machine measured then: Other, 2 cores; here Toy, 2 cores"));
  EXPECT_THAT(text, HasSubstr("reduced, 1000 particles, 1 thread: not measured then"));
  EXPECT_THAT(text, HasSubstr("paper, 5000 particles, 1 thread: measured then only"));
}

TEST(Comparison, RefusesWhatIsNoResult) {
  nlohmann::json caseless = toJson(toyOutcome());
  caseless["cases"] = nlohmann::json::array();
  nlohmann::json mistyped = toJson(toyOutcome());
  mistyped["cases"][0]["threads"] = "two";
  nlohmann::json still = toJson(toyOutcome());
  still["cases"][0]["m_updates_per_s"] = 0.0;
  nlohmann::json stageless = toJson(toyOutcome());
  stageless["cases"][0].erase("stages");
  for (const std::string& text : {std::string{}, std::string{"[]"}, std::string{"{}"}, std::string{"a table"}, caseless.dump(),
                                  mistyped.dump(), still.dump(), stageless.dump()}) {
    const auto parsed = parseBench(text, "file.json");
    ASSERT_FALSE(parsed.ok()) << text;
    EXPECT_EQ(parsed.status().code(), StatusCode::data_loss);
    EXPECT_THAT(parsed.status().message(), HasSubstr("'file.json' is not a result of 'bleedlab bench --json'"));
  }
  EXPECT_EQ(readBench("/nosuch.json").status().code(), StatusCode::not_found);
  EXPECT_EQ(readBench("/").status().code(), StatusCode::not_found);
}

TEST(MeasureCases, MeasuresEachCaseUnderTheCeilingsOfItsThreads) {
  std::vector<BenchCase> cases;
  for (const std::string& name : blockModelNames())
    cases.push_back({name, "", stillBlock(blockModelOf(name), 1000), kBlockStep, 0.0, name == "full" ? 2 : 1});
  const auto outcome = measureCases(cases, {.seconds = 0.01}, [](double) {});
  ASSERT_TRUE(outcome.ok()) << outcome.status().message();
  ASSERT_EQ(outcome->cases.size(), cases.size());
  EXPECT_EQ(outcome->ceilings.size(), 2u);
  for (const MeasuredCase& one : outcome->cases) {
    EXPECT_EQ(one.particles, 1000u);
    EXPECT_GE(one.turns, kLeastBenchTurns);
    EXPECT_GT(one.updates.median, 0.0);
    EXPECT_LE(one.updates.least, one.updates.median);
    EXPECT_GE(one.updates.most, one.updates.median);
    EXPECT_DOUBLE_EQ(one.dt, kBlockStep);
    EXPECT_NEAR(one.census.neighbors, takeCensus(*worldOf(stillBlock(blockModelOf(one.model), 1000))).neighbors, 1.0)
        << "brought back to its start";
    EXPECT_GT(one.bytes, 0.0);
    EXPECT_GT(outcome->ceilingOf(one.threads).gflops.median, 0.0);
    EXPECT_GT(outcome->ceilingOf(one.threads).gigabytes_s.median, 0.0);
  }
}

TEST(BenchScene, IsAPoolOfTwentyThousandWithFourWounds) {
  const auto scene = scene::loadScene(BENCH_SCENE_DIR "/bowl_20k.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->world.wounds.size(), 4u);
  const auto world = worldOf(scene->world);
  ASSERT_NE(world, nullptr);
  EXPECT_NEAR(world->particleCount(), 20000.0, 1000.0);
}

TEST(MeasureCases, SaysWhichCaseFailsAndWhy) {
  sph::WorldDescription dry = stillBlock(BlockModel::reduced, 1000);
  dry.fluid_blocks.clear();
  auto failed = measureCases({{"scene", "dry.textproto", dry, 0.0, 0.0, 1}}, {.seconds = 0.01}, [](double) {});
  ASSERT_FALSE(failed.ok());
  EXPECT_THAT(failed.status().message(), HasSubstr("dry.textproto, 1 thread: there is no blood yet"));
  sph::WorldDescription fast = stillBlock(BlockModel::reduced, 1000);
  failed = measureCases({{"reduced", "", fast, 0.5 * kBlockStep, 0.0, 1}, {"reduced", "", fast, 1.0, 0.0, 1}}, {.seconds = 0.01},
                        [](double) {});
  ASSERT_FALSE(failed.ok());
  EXPECT_THAT(failed.status().message(), HasSubstr("steps are 2e-06 s long, not 1 s"));
}

}  // namespace
}  // namespace bleedsim::lab
