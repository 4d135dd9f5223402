// What only the solver can tell of a scene: told with field path, value and range, all at once and beside the other problems.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "scene_text.h"
#include "service/scene/change_effect.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// A flat domain of +-50 mm, 1 mm spacing, made for 0.3 m/s.
std::string sceneWith(const std::string& wounds, const std::string& effects = "pressure {} viscosity {}") {
  return fmt::format(R"(domain {{ lower_m {{ x: -0.05 y: -0.05 z: -0.02 }} upper_m {{ x: 0.05 y: 0.05 z: 0.05 }} capacity: 5000 }}
resolution {{ spacing_m: 0.001 }}
compressibility {{ design_speed_m_per_s: 0.3 }}
effects {{ {} }}
{})",
                     effects, wounds);
}

std::string disc(double x, double flow, double radius = 0.003) {
  return fmt::format("wounds {{ position_m {{ x: {} }} disc {{ radius_m: {} }} flow_ml_per_s: {} }}\n", x, radius, flow);
}

/// The lines of the problems alone.
std::vector<std::string> problemsOf(const std::string& text) {
  const Result<SceneDescription> scene = parseScene(text);
  std::vector<std::string> lines;
  if (scene.ok()) return lines;
  EXPECT_EQ(scene.status().code(), StatusCode::invalid_argument);
  std::istringstream message{scene.status().message()};
  std::string line;
  std::getline(message, line);
  while (std::getline(message, line)) lines.push_back(line);
  return lines;
}

TEST(WorldRules, AllProblemsOfWoundsAndBlocksAreToldAtOnce) {
  const std::string text = sceneWith(disc(0.0, 50.0) + disc(0.004, 1.0) + disc(0.049, 1.0) +
                                     "fluid_blocks { lower_m { x: -0.04 y: -0.04 z: 0.01 } "
                                     "upper_m { x: -0.03 y: -0.03 z: 0.06 } }\n");
  EXPECT_THAT(problemsOf(text),
              testing::UnorderedElementsAre(
                  AllOf(StartsWith("wounds[0].flow_ml_per_s: value 50 is out of range, allowed 0 to 8.48 (mL/s)"),
                        HasSubstr("made for 0.3 m/s"), HasSubstr("design_speed_m_per_s to 1.77")),
                  AllOf(StartsWith("wounds[1].position_m: value (0.004, 0, 0) overlaps wounds[0] at (0, 0, 0), allowed are"),
                        HasSubstr("one spacing, 0.001 m, apart")),
                  StartsWith("wounds[2].position_m.x: value 0.049 lets the patch reach out of the domain, allowed -0.047"),
                  StartsWith("fluid_blocks[0].upper_m.z: value 0.06 is outside the domain, allowed -0.02 to 0.05 (m)")));
}

TEST(WorldRules, WhatIsAllowedIsAccepted) {
  EXPECT_THAT(problemsOf(sceneWith(disc(0.0, 8.48) + disc(0.008, 1.0) + disc(0.047, 1.0))), IsEmpty());
}

TEST(WorldRules, TheyStandBesideProblemsOfFields) {
  const std::string text = replaced(sceneWith(disc(0.0, -1.0) + disc(0.02, 50.0) + disc(0.0, 1.0, 0.5)), "{ spacing_m: 0.001 }",
                                    "{ spacing_m: 0.001 } max_dt_s: 7");
  EXPECT_THAT(problemsOf(text),
              ElementsAre(StartsWith("max_dt_s: value 7"), StartsWith("wounds[0].flow_ml_per_s: value -1"),
                          StartsWith("wounds[2].disc.radius_m: value 0.5"), StartsWith("wounds[1].flow_ml_per_s: value 50")))
      << "a wound with a problem of its own is not judged any further";
}

TEST(WorldRules, NothingIsJudgedByNumbersThatAreWrong) {
  const std::string text = sceneWith(disc(0.0, 50.0) + disc(0.004, 1.0));
  EXPECT_THAT(problemsOf(replaced(text, "design_speed_m_per_s: 0.3", "design_speed_m_per_s: -1")),
              ElementsAre(StartsWith("compressibility.design_speed"), StartsWith("wounds[1].position_m: ")));
  EXPECT_THAT(problemsOf(replaced(text, "viscosity {}", "gravity { acceleration_m_per_s2 { z: 5000 } }")),
              ElementsAre(StartsWith("effects.gravity"), StartsWith("wounds[1].position_m: ")));
  EXPECT_THAT(problemsOf(replaced(text, "spacing_m: 0.001", "spacing_m: 0")), ElementsAre(StartsWith("resolution.spacing_m")));
  EXPECT_THAT(problemsOf(replaced(text, "x: 0.05 y", "x: nan y")), ElementsAre(StartsWith("domain.upper_m.x")));
}

struct Case {
  std::string wounds;
  std::string problem;
};

TEST(WorldRules, EachNamesItsField) {
  const std::vector<Case> cases{
      {"wounds { disc { radius_m: 0.003 } pressure { inlet_pressure_mmhg: 20 discharge_coefficient: 1 } }\n"
       "wounds { position_m { x: 0.02 } disc { radius_m: 0.003 } flow_ml_per_s: 500 }\n",
       "wounds[1].flow_ml_per_s: value 500 is out of range, allowed 0 to "},
      {"wounds { polygon { points_m {} points_m { u: 0.01 v: 0.01 } points_m { u: 0.01 } points_m { v: 0.01 } } "
       "flow_ml_per_s: 1 }\n",
       "wounds[0].polygon: polygon patch crosses itself"},
      {"wounds { polyline { points_m {} points_m {} points_m { u: 0.01 } width_m: 0.002 } flow_ml_per_s: 1 }\n",
       "wounds[0].polyline: polyline patch points 0 and 1 coincide"},
      {"wounds { ellipse { semi_axis_u_m: 0.06 semi_axis_v_m: 0.003 } flow_ml_per_s: 1 }\n",
       "wounds[0].ellipse: the patch is wider along x than the domain, allowed -0.05 to 0.05 (m)"},
  };
  for (const Case& one : cases) { EXPECT_THAT(problemsOf(sceneWith(one.wounds)), ElementsAre(StartsWith(one.problem))); }
  const std::string pressure =
      "wounds { disc { radius_m: 0.003 } pressure { inlet_pressure_mmhg: 20 discharge_coefficient: 1 } }\n";
  EXPECT_THAT(problemsOf(sceneWith(pressure)), IsEmpty()) << "a scene's own inlet pressure sets its speed of sound";
}

TEST(WorldRules, WoundsThatBleedInsideTissueAreToldBesideAllElse) {
  const std::string tissue = "tissue { name: \"liver\" plane { normal { z: 1 } } }\n";
  const std::string at = "wounds { disc { radius_m: 0.003 } flow_ml_per_s: ";
  const std::string text =
      sceneWith(tissue + at + "1 position_m { z: -0.004 } }\n" + at + "1 position_m { x: 0.01 } normal { z: -1 } }\n" + at +
                "500 position_m { x: 0.02 } normal { x: 1 z: 1 } }\n" + at + "-1 position_m { z: -0.004 } }\n" + at +
                "1 position_m { x: -0.02 z: -0.0005 } }\n");
  EXPECT_THAT(
      problemsOf(text),
      testing::UnorderedElementsAre(
          "wounds[0].position_m: value (0, 0, -0.004) m is 4 mm inside tissue: use (0, 0, 0) m, on the surface of 'liver'",
          "wounds[1].normal: value (0, 0, -1) lets blood out 0.5 mm inside tissue at (0.01, 0, 0) m: turn it to the blood's "
          "side, (0, 0, 1) of 'liver'",
          AllOf(StartsWith("wounds[2].disc: reaches "), HasSubstr("turn its normal to (0, 0, 1) of 'liver'")),
          StartsWith("wounds[2].flow_ml_per_s: value 500"), StartsWith("wounds[3].flow_ml_per_s: value -1")))
      << "one with a problem of its own is not judged any further";
  const std::string bad_tissue = replaced(text, "plane { normal { z: 1 } }", "plane { normal { z: 0 } }");
  EXPECT_THAT(problemsOf(bad_tissue), Not(testing::Contains(HasSubstr("inside tissue"))));
}

TEST(WorldRules, APatchMustNotMeetItselfAcrossAPeriodicSide) {
  const std::string text = replaced(sceneWith(disc(0.0, 1.0, 0.05)), "capacity", "periodic_x: true periodic_y: true capacity");
  EXPECT_THAT(problemsOf(text), ElementsAre(AllOf(StartsWith("wounds[0].disc: reaches "), HasSubstr("allowed 0 to 0.0495 (m)"))));
}

TEST(WorldRules, BlocksThatTheEffectsCannotWorkWithAreNamed) {
  const std::string block = "fluid_blocks { lower_m {} upper_m { x: 0.01 y: 0.01 z: 0.01 } viscosity_pa_s: 0 }\n";
  EXPECT_THAT(problemsOf(sceneWith(block)), IsEmpty());
  EXPECT_THAT(
      problemsOf(sceneWith(block, "pressure {} viscosity { casson {} }")),
      ElementsAre(AllOf(StartsWith("fluid_blocks[0].viscosity_pa_s: "), HasSubstr("allowed more than 0 to 1000 (Pa s)"))));
}

/// A planar domain, one particle of 1 mm high.
std::string planarWith(const std::string& rest, const std::string& effects = "pressure {} viscosity {}") {
  return replaced(sceneWith(rest, effects), "capacity", "planar: true capacity");
}

TEST(WorldRules, NoProblemOfABlockHidesAnother) {
  const std::string flat = "fluid_blocks { lower_m {} upper_m { x: 0.01 y: 0.01 z: 0.001 } }\n";
  const std::string second =
      "fluid_blocks { lower_m { x: 0.02 z: 0.002 } upper_m { x: 0.03 y: 0.01 z: 0.004 } velocity_m_per_s { z: 200 } jitter: 7 "
      "viscosity_pa_s: 0 }\n";
  EXPECT_THAT(problemsOf(planarWith(flat)), IsEmpty());
  EXPECT_THAT(problemsOf(planarWith(flat + second)),
              testing::UnorderedElementsAre(StartsWith("fluid_blocks[1].jitter: value 7"),
                                            StartsWith("fluid_blocks[1].velocity_m_per_s: value 200"),
                                            StartsWith("fluid_blocks[1]: must be one particle high"),
                                            StartsWith("fluid_blocks[1]: must stand at one height with the first"),
                                            StartsWith("fluid_blocks[1].velocity_m_per_s: must be in the plane")));
  EXPECT_THAT(problemsOf(sceneWith(second, "pressure {} viscosity { casson {} }")),
              testing::UnorderedElementsAre(StartsWith("fluid_blocks[0].jitter: value 7"),
                                            StartsWith("fluid_blocks[0].velocity_m_per_s: value 200"),
                                            StartsWith("fluid_blocks[0].viscosity_pa_s: value 0")));
}

TEST(WorldRules, WhatAPlanarWorldLacksIsToldBesideWrongNumbersOfIt) {
  const std::string text = planarWith(disc(0.0, -1.0) + "tissue { plane { normal { z: 1 } } slip: 7 }\n",
                                      "pressure {} viscosity {} platelets { fresh: 7 }");
  EXPECT_THAT(problemsOf(text),
              testing::UnorderedElementsAre(
                  StartsWith("effects.platelets.fresh: value 7"), StartsWith("effects.platelets: not in"),
                  StartsWith("tissue[0].slip: value 7"), StartsWith("tissue: not in a planar world"),
                  StartsWith("wounds[0].flow_ml_per_s: value -1"), StartsWith("wounds: not in a planar world")));
}

TEST(WorldRules, AWorldIsMadeOfWhatTheyAccept) {
  const Result<SceneDescription> scene = parseScene(kFullScene);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto world = sph::createWorld(scene->world, {});
  EXPECT_TRUE(world.ok()) << world.status().message();
}

TEST(WorldRules, ARunningWorldKeepsItsSpeedOfSoundWhenAnEffectIsSwitched) {
  // Falling from 0.1 m makes the scene good for 1.4 m/s; without gravity it would be good for 0.3 m/s only.
  const std::string text = replaced(sceneWith(disc(0.0, 30.0), "gravity {} pressure {}"), "0.3", "0.3 max_fall_or_depth_m: 0.1");
  const Result<SceneDescription> scene = parseScene(text);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const double speed = sph::speedOfSound(scene->world);
  const EffectChange off{.name = "gravity", .enabled = false, .settings = {}};
  EXPECT_TRUE(changeEffect(*scene, off, {.speed_of_sound = speed}).ok());
  sph::WorldDescription without = scene->world;
  without.effects.gravity.reset();
  const Result<SceneDescription> alone = changeEffect(*scene, off, {.speed_of_sound = sph::speedOfSound(without)});
  ASSERT_FALSE(alone.ok());
  EXPECT_THAT(alone.status().message(), StartsWith("wounds[0].flow_ml_per_s: value 30 is out of range"));
}

}  // namespace
}  // namespace bleedsim::scene
