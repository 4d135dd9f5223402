// The choice of a resolution: the search by models that are known exactly, and what a model says of a scene.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/lab/choose/chooser.h"
#include "service/scene/change_resolution.h"

namespace bleedsim::lab {
namespace {

using testing::HasSubstr;

/// A frame takes 1 ms at dx = 1 mm and Mach factor 10 and goes with mach dx^-4, the error is 1 % there and goes with dx^2, the
/// compression is 1 % at Mach factor 10. h = 3 dx takes twice the time and has half the error.
ChoiceModels simpleModels() {
  ChoiceModels models;
  models.support_ratios = {2.0, 3.0};
  models.time = [](double support, double spacing, double mach) {
    FrameTime time;
    time.milliseconds = (support > 2.0 ? 2.0 : 1.0) * mach / 10.0 * std::pow(spacing / 0.001, -4.0);
    time.particles = 1000;
    time.steps = 10.0;
    return time;
  };
  models.error = [](double support, double spacing, double mach) {
    const double fine = spacing / 0.001;
    return PredictedError{(support > 2.0 ? 0.005 : 0.01) * fine * fine, 1.0 / (mach * mach)};
  };
  return models;
}

TEST(Choose, TakesTheMostAccurateSettingThatFits) {
  const ChoiceModels models = simpleModels();
  const auto choice = choose(models, {16.0, {}, 0.01});
  ASSERT_TRUE(choice.ok()) << choice.status().message();
  EXPECT_LE(choice->time.milliseconds, kBudgetPart * 16.0);
  for (const double support : models.support_ratios) {
    for (const double mach : {5.0, 10.0, 20.0}) {
      for (double spacing = 0.0005; spacing < 0.005; spacing += 0.0001) {
        if (models.time(support, spacing, mach).milliseconds > kBudgetPart * 16.0) continue;
        EXPECT_LE(choice->error.total(), 1.06 * models.error(support, spacing, mach).total()) << spacing << " " << mach;
      }
    }
  }
}

TEST(Choose, TakesTheFastestSettingThatKeepsAnError) {
  const ChoiceModels models = simpleModels();
  const auto choice = choose(models, {1000.0, 0.04, 0.01});
  ASSERT_TRUE(choice.ok()) << choice.status().message();
  EXPECT_LE(choice->error.total(), 0.04);
  EXPECT_LT(choice->time.milliseconds, models.time(2.0, 0.001, 10.0).milliseconds) << "1 mm is more than is asked for";
}

TEST(Choose, MoreTimeIsNeverWorse) {
  double before = 1.0;
  for (const double budget : {1.0, 4.0, 16.0, 64.0}) {
    const auto choice = choose(simpleModels(), {budget, {}, 0.01});
    ASSERT_TRUE(choice.ok()) << choice.status().message();
    EXPECT_LE(choice->error.total(), before);
    before = choice->error.total();
  }
}

TEST(Choose, RefusesWithTheFigureThatDecides) {
  // Two across 1 mm are dx = 0.5 mm: 8 ms at Mach factor 5 and h = 2 dx.
  const auto time = choose(simpleModels(), {5.0, {}, 0.001});
  ASSERT_FALSE(time.ok());
  EXPECT_EQ(time.status().code(), StatusCode::capacity);
  EXPECT_THAT(time.status().message(), testing::AllOf(HasSubstr("nothing fits 5 ms"), HasSubstr("8 ms a frame"),
                                                      HasSubstr("dx = 0.50 mm"), HasSubstr("raise --budget-ms")));
  const auto both = choose(simpleModels(), {0.2, 0.02, 0.01});
  ASSERT_FALSE(both.ok());
  EXPECT_THAT(both.status().message(),
              testing::AllOf(HasSubstr("the cheapest setting that keeps an error of 2 %"), HasSubstr("--error")));
  const auto error = choose(simpleModels(), {1e9, 0.001, 0.01});
  ASSERT_FALSE(error.ok());
  EXPECT_THAT(error.status().message(), HasSubstr("nothing keeps an error of 0.1 %"));
}

TEST(Choose, RefusesWhatCannotBeResolved) {
  const auto choice = choose(simpleModels(), {16.0, {}, 1e-5});
  ASSERT_FALSE(choice.ok());
  EXPECT_EQ(choice.status().code(), StatusCode::invalid_argument);
  EXPECT_THAT(choice.status().message(), HasSubstr("--feature-mm"));
}

sph::WorldDescription woundScene() {
  sph::WorldDescription scene;
  scene.spacing = 0.002;
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  sph::WoundDescription wound;
  wound.shape = sph::DiscPatch{0.003};
  wound.drive = sph::FlowDrive{2e-6};
  scene.wounds.push_back(wound);
  return scene;
}

TEST(TimeModel, ScalesCountAndStepsWithTheSpacing) {
  SceneSample coarse;
  coarse.scene = woundScene();
  coarse.scene.spacing = 0.004;
  coarse.particles = 100;
  coarse.microseconds = 0.5;
  coarse.dt = longestStep(coarse.scene, 0.1);
  coarse.max_speed = 0.1;
  SceneSample fine = coarse;
  fine.scene.spacing = 0.002;
  fine.particles = 800;
  fine.dt = longestStep(fine.scene, 0.1);
  const TimeModel model{coarse, fine};
  const FrameTime same = model.predict(0.002, 10.0, 60.0);
  EXPECT_EQ(same.particles, 800u);
  EXPECT_NEAR(same.steps, 1.0 / (60.0 * fine.dt), 1e-9);
  const FrameTime half = model.predict(0.001, 10.0, 60.0);
  EXPECT_EQ(half.particles, 6400u);
  EXPECT_NEAR(half.steps / same.steps, 2.0, 1e-9);
  EXPECT_NEAR(half.milliseconds / same.milliseconds, 16.0, 1e-6);
  EXPECT_NEAR(model.predict(0.002, 20.0, 60.0).steps / same.steps, 2.0, 0.1) << "sound twice as fast";
}

TEST(TimeModel, FollowsWhatAParticleCosts) {
  SceneSample coarse;
  coarse.scene = woundScene();
  coarse.particles = 100;
  coarse.microseconds = 0.5;
  coarse.dt = 1e-4;
  SceneSample fine = coarse;
  fine.particles = 1000;
  fine.microseconds = 0.55;
  const FrameTime finer = TimeModel{coarse, fine}.predict(0.5 * fine.scene.spacing, 10.0, 60.0);
  EXPECT_GT(finer.microseconds, 0.55);
  fine.microseconds = 50.0;  // a disturbed run
  EXPECT_LT((TimeModel{coarse, fine}.predict(0.5 * fine.scene.spacing, 10.0, 60.0).microseconds), 100.0);
}

TEST(Volume, IsWhatBlocksHoldAndWoundsBring) {
  sph::WorldDescription scene = woundScene();
  EXPECT_NEAR(volumeOf(scene, 5.0), 1e-5, 1e-12);
  sph::FluidBlock block;
  block.upper = {0.01, 0.01, 0.01};
  scene.fluid_blocks.push_back(block);
  EXPECT_NEAR(volumeOf(scene, 5.0), 1.1e-5, 1e-12);
}

TEST(RunScene, MeasuresTheEndOfTheHorizon) {
  auto scene = scene::loadScene(std::string{SCENE_DIR} + "/round_wound.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto sample = runScene(scene->world, 1.0, 60.0, {});
  ASSERT_TRUE(sample.ok()) << sample.status().message();
  EXPECT_NEAR(sample->particles * scene->world.particleVolume(), 1.5e-6, 0.05e-6);
  EXPECT_GT(sample->frame_ms, 0.0);
  EXPECT_NEAR(sample->dt, longestStep(scene->world, sample->max_speed), 0.5 * sample->dt);
  const auto nothing = runScene(scene->world, 1e-6, 60.0, {});
  ASSERT_FALSE(nothing.ok());
  EXPECT_THAT(nothing.status().message(), HasSubstr("--horizon"));
}

TEST(ChangeResolution, GivesAValidSceneOfTheSameContent) {
  const auto scene = scene::loadScene(std::string{SCENE_DIR} + "/all_effects.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto changed = scene::changeResolution(*scene, {.spacing = 0.5 * scene->world.spacing,
                                                        .support_ratio = 3.0,
                                                        .mach_factor = 14.0,
                                                        .capacity = 0,
                                                        .left_out = {"platelets", "core_radius"}});
  ASSERT_TRUE(changed.ok()) << changed.status().message();
  EXPECT_EQ(changed->world.spacing, 0.5 * scene->world.spacing);
  EXPECT_EQ(changed->world.support_ratio, 3.0);
  EXPECT_EQ(changed->world.compressibility.mach_factor, 14.0);
  EXPECT_EQ(changed->world.capacity, scene->world.capacity) << "never less than the scene has";
  EXPECT_FALSE(changed->world.effects.platelets.has_value());
  EXPECT_FALSE(changed->world.effects.core_radius.has_value());
  EXPECT_TRUE(changed->world.effects.surface_tension.has_value());
  EXPECT_EQ(changed->world.wounds.size(), scene->world.wounds.size());
  const auto again = scene::parseScene(changed->normalized_text);
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(again->world.spacing, changed->world.spacing);
}

TEST(ChangeResolution, RefusesWhatIsNoScene) {
  const auto scene = scene::loadScene(std::string{SCENE_DIR} + "/round_wound.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const scene::ResolutionChange fine{.spacing = 0.002, .support_ratio = 2.0, .mach_factor = 10.0, .capacity = 0, .left_out = {}};
  scene::ResolutionChange change = fine;
  change.left_out = {"magic"};
  EXPECT_EQ(scene::changeResolution(*scene, change).status().code(), StatusCode::not_found);
  change = fine;
  change.spacing = 1.0;
  EXPECT_THAT(scene::changeResolution(*scene, change).status().message(), HasSubstr("spacing_m"));
}

}  // namespace
}  // namespace bleedsim::lab
