#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <variant>

#include "scene_text.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string messageOf(const std::string& text) { return parseScene(text).status().message(); }

TEST(ParseScene, ConvertsToSiUnits) {
  const Result<SceneDescription> result = parseScene(kFullScene);
  ASSERT_TRUE(result.ok()) << result.status().message();
  const sph::WorldDescription& world = result->world;
  EXPECT_EQ(result->name, "full");
  EXPECT_EQ(result->description, "all of it");
  EXPECT_EQ(result->frame_id, "table");
  EXPECT_EQ(result->frame_rate, 30.0);
  EXPECT_EQ(result->attributes, sph::kFrameVelocity | sph::kFrameViscosity);
  EXPECT_EQ(result->instrument_expiry, 0.2);
  EXPECT_THAT(result->effects, ElementsAre("gravity", "pressure", "viscosity", "applied_force"));
  EXPECT_EQ(world.seed, 7u);
  EXPECT_EQ(world.domain.lower, sph::Vec3(-0.05, -0.05, -0.02));
  EXPECT_EQ(world.domain.upper, sph::Vec3(0.05, 0.05, 0.05));
  EXPECT_THAT(world.domain.periodic, ElementsAre(true, false, false));
  EXPECT_EQ(world.capacity, 5000u);
  EXPECT_EQ(world.spacing, 0.002);
  EXPECT_EQ(world.support_ratio, 2.5);
  EXPECT_EQ(world.rest_density, 1050.0);
  EXPECT_EQ(world.compressibility.mach_factor, 12.0);
  EXPECT_EQ(world.compressibility.design_speed, 0.4);
  EXPECT_EQ(world.compressibility.max_fall_or_depth, 0.01);
  EXPECT_EQ(world.effects.gravity->acceleration, sph::Vec3(0, 0, -9.5));
  EXPECT_EQ(world.effects.pressure->background_pressure, 3.0);
  EXPECT_EQ(world.effects.viscosity->viscosity, 0.005);
  EXPECT_EQ(world.effects.applied_force->max_sources, 8u);
  EXPECT_EQ(world.max_wounds, 9u);
  EXPECT_EQ(world.max_dt, 0.01);
}

TEST(ParseScene, ConvertsTissueWoundsAndBlocks) {
  const Result<SceneDescription> result = parseScene(kFullScene);
  ASSERT_TRUE(result.ok()) << result.status().message();
  const sph::WorldDescription& world = result->world;
  ASSERT_EQ(world.tissue.size(), 3u);
  EXPECT_EQ(std::get<sph::PlaneShape>(world.tissue[0].shape).normal, sph::Vec3(0, 0, 1)) << "normals become unit vectors";
  EXPECT_EQ(std::get<sph::PlaneShape>(world.tissue[0].shape).point.z(), -0.001);
  EXPECT_EQ(world.tissue[0].slip, 0.25);
  const auto& box = std::get<sph::BoxShape>(world.tissue[1].shape);
  EXPECT_TRUE(box.open_top);
  EXPECT_FALSE(box.obstacle);
  EXPECT_EQ(box.upper, sph::Vec3(0.04, 0.04, 0.04));
  EXPECT_EQ(world.tissue[1].slip, 0.0);
  const auto& bowl = std::get<sph::BowlShape>(world.tissue[2].shape);
  EXPECT_EQ(bowl.sphere_radius, 0.03);
  EXPECT_EQ(bowl.depth, 0.01);
  EXPECT_EQ(bowl.rim_center.z(), -0.002);

  ASSERT_EQ(world.wounds.size(), 4u);
  EXPECT_EQ(world.wounds[0].normal, sph::Vec3(0, 0, 1));
  EXPECT_EQ(std::get<sph::DiscPatch>(world.wounds[0].shape).radius, 0.003);
  EXPECT_DOUBLE_EQ(std::get<sph::FlowDrive>(world.wounds[0].drive).flow, 2e-6);
  EXPECT_EQ(world.wounds[1].tangent, sph::Vec3(1, 0, 0));
  EXPECT_EQ(std::get<sph::EllipsePatch>(world.wounds[1].shape).semi_axis_v, 0.001);
  EXPECT_DOUBLE_EQ(std::get<sph::PressureDriveSettings>(world.wounds[1].drive).inlet_pressure, 133.322387415);
  EXPECT_EQ(std::get<sph::PressureDriveSettings>(world.wounds[1].drive).discharge_coefficient, 0.7);
  EXPECT_EQ(std::get<sph::PolygonPatch>(world.wounds[2].shape).points.at(2), sph::Vec2(0, 0.004));
  EXPECT_EQ(std::get<sph::PolylinePatch>(world.wounds[3].shape).width, 0.0015);

  ASSERT_EQ(world.fluid_blocks.size(), 2u);
  EXPECT_EQ(world.fluid_blocks[0].velocity, sph::Vec3(0.5, 0, 0));
  EXPECT_EQ(world.fluid_blocks[0].jitter, 0.1);
  EXPECT_EQ(world.fluid_blocks[0].viscosity, 0.006);
  EXPECT_FALSE(world.fluid_blocks[1].viscosity.has_value());
}

TEST(ParseScene, FillsDefaults) {
  const Result<SceneDescription> result = parseScene(kLeastScene);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result->frame_id, "bleedsim");
  EXPECT_EQ(result->frame_rate, 60.0);
  EXPECT_EQ(result->attributes, 0u);
  EXPECT_EQ(result->instrument_expiry, 0.1);
  EXPECT_THAT(result->effects, IsEmpty());
  EXPECT_EQ(result->world.seed, 1u);
  EXPECT_EQ(result->world.support_ratio, 2.0);
  EXPECT_EQ(result->world.rest_density, 1060.0);
  EXPECT_EQ(result->world.compressibility.mach_factor, 10.0);
  EXPECT_EQ(result->world.max_wounds, 64u);
  EXPECT_EQ(result->world.max_dt, std::numeric_limits<double>::infinity());
}

TEST(ParseScene, TheDefaultsOfEffectsAndWounds) {
  const Result<SceneDescription> result = parseScene(std::string{kLeastScene} +
                                                     "effects { gravity {} viscosity {} applied_force {} }"
                                                     "wounds { disc { radius_m: 0.001 } pressure { inlet_pressure_mmhg: 0.5 } }");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_THAT(result->effects, ElementsAre("gravity", "viscosity", "applied_force"));
  EXPECT_FALSE(result->world.effects.pressure.has_value());
  EXPECT_EQ(result->world.effects.gravity->acceleration, sph::Vec3(0, 0, -9.81));
  EXPECT_EQ(result->world.effects.viscosity->viscosity, 0.00345);
  EXPECT_EQ(result->world.effects.applied_force->max_sources, 64u);
  EXPECT_EQ(result->world.wounds.at(0).normal, sph::Vec3(0, 0, 1));
  EXPECT_EQ(std::get<sph::PressureDriveSettings>(result->world.wounds[0].drive).discharge_coefficient, 0.61);
}

TEST(ParseScene, AnExplicitZeroIsNotADefault) {
  const Result<SceneDescription> result =
      parseScene(std::string{kLeastScene} + "effects { gravity { acceleration_m_per_s2 {} } viscosity { viscosity_pa_s: 0 } }");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result->world.effects.gravity->acceleration, sph::Vec3(0, 0, 0));
  EXPECT_EQ(result->world.effects.viscosity->viscosity, 0.0);
}

TEST(ParseScene, ReportsAllProblemsAtOnce) {
  std::string text = replaced(kFullScene, "slip: 0.25", "slip: 7");
  text = replaced(text, "radius_m: 0.003", "radius_mm: 3");
  text = replaced(text, "capacity: 5000", "capacity: 0");
  text = replaced(text, "z: -9.5", "z: nan");
  text = replaced(text, "frame_rate_hz: 30", "frame_rate: 30");
  const std::string message = messageOf(text);
  EXPECT_THAT(message, HasSubstr("the scene has 7 problems:\n"));
  EXPECT_THAT(message, HasSubstr("tissue[0].slip: value 7 is out of range, allowed 0 to 1"));
  EXPECT_THAT(message, HasSubstr("unknown field 'radius_mm' in Disc; did you mean 'radius_m'?"));
  EXPECT_THAT(message, HasSubstr("wounds[0].disc.radius_m: value 0 is out of range"));
  EXPECT_THAT(message, HasSubstr("domain.capacity: value 0 is out of range"));
  EXPECT_THAT(message, HasSubstr("domain.capacity: value 0 is less than the 250 particles"));
  EXPECT_THAT(message, HasSubstr("effects.gravity.acceleration_m_per_s2.z: value nan is not finite"));
  EXPECT_THAT(message, HasSubstr("unknown field 'frame_rate' in Output; did you mean 'frame_rate_hz'?"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 7);
}

TEST(ParseScene, UnknownFieldsAreAllReportedWithTheirPlace) {
  const std::string message = messageOf(std::string{kLeastScene} + "max_dt: 1\nwound { a: 1 b { c: 2 } }\n");
  EXPECT_THAT(message, HasSubstr("line 4:7: unknown field 'max_dt' in Scene; did you mean 'max_dt_s'?"));
  EXPECT_THAT(message, HasSubstr("unknown field 'wound' in Scene; did you mean 'wounds'?"));
}

TEST(ParseScene, AnUnknownFieldUnlikeAnyListsTheKnownOnes) {
  EXPECT_THAT(messageOf(replaced(kFullScene, "radius_m: 0.003", "xyzzy_plugh: 3")),
              HasSubstr("unknown field 'xyzzy_plugh' in Disc; known are radius_m"));
}

TEST(ParseScene, SyntaxErrorsCarryLineAndColumn) {
  EXPECT_THAT(messageOf("name: \"a\"\nseed: : 1\n"), HasSubstr("line 2:7: "));
  EXPECT_THAT(messageOf("name: \"a\" name: \"b\""), HasSubstr("specified multiple times"));
  EXPECT_THAT(messageOf("domain {"), HasSubstr("line 1:9: "));
  EXPECT_THAT(messageOf("seed: -1"), HasSubstr("line 1:"));
  EXPECT_THAT(messageOf("output { attributes: SPIN }"), HasSubstr("SPIN"));
  EXPECT_THAT(messageOf(replaced(kFullScene, "flow_ml_per_s: 2", "flow_ml_per_s: 2 pressure {}")), HasSubstr("drive"));
}

TEST(ParseScene, AnEmptyTextNamesWhatIsRequired) {
  const std::string message = messageOf("");
  EXPECT_THAT(message, HasSubstr("domain: is required"));
  EXPECT_THAT(message, HasSubstr("resolution: is required"));
  EXPECT_THAT(message, HasSubstr("compressibility: is required"));
}

TEST(ParseScene, HugeAndDeepTextsAreRefused) {
  EXPECT_THAT(messageOf(std::string(kMaxSceneBytes + 1, ' ')), HasSubstr("has 1048577 bytes, allowed are at most 1048576"));
  EXPECT_FALSE(parseScene(repeated("a{", 500'000)).ok());
  EXPECT_FALSE(parseScene("wounds { " + repeated("a <", 300'000)).ok());
  EXPECT_FALSE(parseScene("seed: " + repeated("[", 1'000'000)).ok());
}

TEST(ParseScene, MessagesStayShortAndPrintable) {
  const std::string message = messageOf("seed: " + std::string(100'000, 'x'));
  EXPECT_LT(message.size(), 2000u);
  for (const char c : messageOf("name: \xff\x01 \x80")) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~'));
}

TEST(ParseScene, ManyProblemsAreCountedBeyondTheBound) {
  const std::string message = messageOf(repeated("bad: 1\n", 1000));
  EXPECT_THAT(message, HasSubstr("the scene has 1003 problems:"));
  EXPECT_THAT(message, HasSubstr("... and 803 more"));
}

}  // namespace
}  // namespace bleedsim::scene
