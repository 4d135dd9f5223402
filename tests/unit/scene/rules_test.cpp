// One row per rule: a change of a valid scene, and the path and words that its problem must have.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_text.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {
namespace {

struct Rule {
  std::string from;
  std::string to;
  std::string path;
  std::string words;
};

/// `start`, then a quoted run of n letters.
std::string quotedRun(std::string_view start, std::size_t n) { return fmt::format("{}\"{:x<{}}\"", start, "", n); }

const std::vector<Rule>& rules() {
  static const std::vector<Rule> kRules{
      // text
      {"\"full\"", quotedRun("", 65), "name: ", "has 65 bytes, allowed are at most 64"},
      {"\"full\"", "\"a\\nb\"", "name: ", "byte 1 (0x0a) is a control character"},
      {"\"full\"", "\"\\377\"", "name: ", "byte 0 (0xff) is not UTF-8"},
      {"\"full\"", "\"\\355\\240\\200\"", "name: ", "is not UTF-8"},
      {"\"full\"", "\"x\\303\"", "name: ", "byte 1 (0xc3) is not UTF-8"},
      {"\"table\"", quotedRun("", 65), "frame_id: ", "has 65 bytes"},
      {"\"all of it\"", quotedRun("", 4097), "description: ", "has 4097 bytes, allowed are at most 4096"},
      // domain
      {"lower_m { x: -0.05 y: -0.05 z: -0.02 }", "", "domain.lower_m: ", "is required"},
      {"upper_m { x: 0.05 y: 0.05 z: 0.05 }", "", "domain.upper_m: ", "is required"},
      {"upper_m { x: 0.05 y", "upper_m { x: nan y", "domain.upper_m.x: ", "value nan is not finite"},
      {"upper_m { x: 0.05 y", "upper_m { x: inf y", "domain.upper_m.x: ", "value inf is not finite"},
      {"upper_m { x: 0.05 y", "upper_m { x: 1e999 y", "domain.upper_m.x: ", "value inf is not finite"},
      {"upper_m { x: 0.05 y", "upper_m { x: 10.5 y", "domain.upper_m.x: ", "value 10.5 is out of range, allowed -10 to 10 (m)"},
      {"upper_m { x: 0.05 y", "upper_m { x: -0.05 y", "domain.upper_m.x: ", "value -0.05 must be above lower_m.x, -0.05 (m)"},
      {"upper_m { x: 0.05 y: 0.05", "upper_m { x: 0.05 y: 9.96",
       "domain: ", "the y side measures 10.01 m, allowed are at most 10 m"},
      {"x: 0.05 y: 0.05 z: 0.05", "x: 5 y: 5 z: 5", "domain: ", "cells of one support radius"},
      {"lower_m { x: -0.05 y", "lower_m { x: 0.04 y", "domain.periodic_x: ", "a periodic one needs at least 0.015"},
      {"capacity: 5000", "", "domain.capacity: ", "value 0 is out of range, allowed 1 to 2000000 (particles); 0 also stands for"},
      {"capacity: 5000", "capacity: 2000001", "domain.capacity: ", "value 2000001 is out of range"},
      {"capacity: 5000", "capacity: 249", "domain.capacity: ", "value 249 is less than the 250 particles of fluid_blocks"},
      // resolution, fluid, compressibility, step
      {"resolution { spacing_m: 0.002 support_ratio: 2.5 }", "", "resolution: ", "is required"},
      {"spacing_m: 0.002", "", "resolution.spacing_m: ", "value 0 is out of range, allowed 1e-05 to 0.02 (m)"},
      {"spacing_m: 0.002", "spacing_m: 0.021", "resolution.spacing_m: ", "value 0.021 is out of range"},
      {"spacing_m: 0.002", "spacing_m: -1", "resolution.spacing_m: ", "value -1 is out of range"},
      {"support_ratio: 2.5", "support_ratio: 1.4", "resolution.support_ratio: ", "allowed 1.5 to 3.5"},
      {"support_ratio: 2.5", "support_ratio: 3.6", "resolution.support_ratio: ", "allowed 1.5 to 3.5"},
      {"density_kg_per_m3: 1050", "density_kg_per_m3: 499", "fluid.density_kg_per_m3: ", "allowed 500 to 5000 (kg/m^3)"},
      {"density_kg_per_m3: 1050", "density_kg_per_m3: 5001", "fluid.density_kg_per_m3: ", "value 5001"},
      {"mach_factor: 12", "mach_factor: 4.9", "compressibility.mach_factor: ", "allowed 5 to 50"},
      {"mach_factor: 12", "mach_factor: 51", "compressibility.mach_factor: ", "allowed 5 to 50"},
      {"design_speed_m_per_s: 0.4", "", "compressibility.design_speed_m_per_s: ", "allowed 0.001 to 20 (m/s)"},
      {"design_speed_m_per_s: 0.4", "design_speed_m_per_s: 21", "compressibility.design_speed_m_per_s: ", "value 21"},
      {"max_fall_or_depth_m: 0.01", "max_fall_or_depth_m: -0.1", "compressibility.max_fall_or_depth_m: ", "allowed 0 to 10 (m)"},
      {"max_fall_or_depth_m: 0.01", "max_fall_or_depth_m: 11", "compressibility.max_fall_or_depth_m: ", "value 11"},
      {"compressibility { mach_factor: 12 design_speed_m_per_s: 0.4 max_fall_or_depth_m: 0.01 }", "",
       "compressibility: ", "is required"},
      {"max_dt_s: 0.01", "max_dt_s: 0", "max_dt_s: ", "value 0 is out of range, allowed 1e-09 to 1 (s)"},
      {"max_dt_s: 0.01", "max_dt_s: 1.5", "max_dt_s: ", "value 1.5"},
      // effects
      {"z: -9.5", "z: -1001", "effects.gravity.acceleration_m_per_s2: ", "value 1001 is out of range, allowed 0 to 1000"},
      {"z: -9.5", "z: -inf", "effects.gravity.acceleration_m_per_s2.z: ", "value -inf is not finite"},
      {"background_pressure_pa: 3", "background_pressure_pa: -1",
       "effects.pressure.background_pressure_pa: ", "allowed 0 to 1000000 (Pa)"},
      {"background_pressure_pa: 3", "background_pressure_pa: 1000001", "effects.pressure.background_pressure_pa: ", "(Pa)"},
      {"viscosity_pa_s: 0.005", "viscosity_pa_s: -0.1", "effects.viscosity.viscosity_pa_s: ", "allowed 0 to 1000 (Pa s)"},
      {"viscosity_pa_s: 0.005", "viscosity_pa_s: 1001", "effects.viscosity.viscosity_pa_s: ", "value 1001"},
      {"max_sources: 8", "max_sources: 0", "effects.applied_force.max_sources: ", "allowed 1 to 256 (sources)"},
      {"max_sources: 8", "max_sources: 257", "effects.applied_force.max_sources: ", "value 257"},
      // tissue
      {"name: \"floor\"", quotedRun("name: ", 65), "tissue[0].name: ", "has 65 bytes"},
      {"plane { point_m { z: -0.001 } normal { z: 2 } }", "", "tissue[0]: ", "has no shape; give one of plane, box, bowl"},
      {"point_m { z: -0.001 }", "point_m { z: 11 }", "tissue[0].plane.point_m.z: ", "value 11 is out of range"},
      {"normal { z: 2 }", "", "tissue[0].plane.normal: ", "has length 0"},
      {"normal { z: 2 }", "normal { z: nan }", "tissue[0].plane.normal.z: ", "not finite"},
      {"slip: 0.25", "slip: 1.01", "tissue[0].slip: ", "value 1.01 is out of range, allowed 0 to 1"},
      {"slip: 0.25", "slip: -0.01", "tissue[0].slip: ", "value -0.01"},
      {"y: 0.04 z: 0.04 }", "y: 0.04 z: -0.04 }", "tissue[1].box.upper_m.z: ", "must be above lower_m.z"},
      {"lower_m { x: -0.04 y: -0.04 z: 0 }", "", "tissue[1].box.lower_m: ", "is required"},
      {"open_top: true", "open_top: true side: OBSTACLE", "tissue[1].box.open_top: ", "is for a CONTAINER"},
      {"open_top: true", "side: 5", "tissue[1].box.side: ", "value 5 is unknown, known are CONTAINER and OBSTACLE"},
      {"sphere_radius_m: 0.03", "", "tissue[2].bowl.sphere_radius_m: ", "value 0 is out of range, allowed 0.0001 to 10"},
      {"0.03 depth_m: 0.01", "0.03 depth_m: 0.031",
       "tissue[2].bowl.depth_m: ", "value 0.031 is out of range, allowed 0.0001 to 0.03"},
      {"0.03 depth_m: 0.01", "0.03", "tissue[2].bowl.depth_m: ", "value 0 is out of range"},
      {"rim_center_m { z: -0.002 }", "rim_center_m { y: -12 }", "tissue[2].bowl.rim_center_m.y: ", "value -12"},
      {"tissue {", repeated("tissue { plane { normal { z: 1 } } }\n", 14) + "tissue {",
       "tissue: ", "17 are given, allowed are at most 16"},
      // wounds
      {"name: \"b\"", "name: \"a\"", "wounds[1].name: ", "'a' is already the name of wounds[0]"},
      {"name: \"b\"", "name: \"\\001\"", "wounds[1].name: ", "control character"},
      {"position_m { x: 0.01 }", "position_m { x: 0.06 }",
       "wounds[0].position_m.x: ", "is outside the domain, allowed -0.05 to 0.05 (m)"},
      {"position_m { x: 0.01 }", "position_m { z: -0.021 }", "wounds[0].position_m.z: ", "is outside the domain"},
      {"position_m { x: 0.01 }", "position_m { x: 0.01 z: -0.006 }", "wounds[0].position_m: ", "mm inside tissue: use ("},
      {"normal { z: 3 }", "normal { z: -3 }", "wounds[0].normal: ", "turn it to the blood's side"},
      {"position_m { x: 0.01 }", "position_m { x: nan }", "wounds[0].position_m.x: ", "not finite"},
      {"normal { z: 3 }", "normal { z: 0 }", "wounds[0].normal: ", "give a vector that is not zero"},
      {"normal { z: 3 }", "normal { z: 1e200 }", "wounds[0].normal: ", "allowed 1e-06 to 1000000"},
      {"tangent { x: 1 }", "tangent { x: 1e-300 }", "wounds[1].tangent: ", "has length 1e-300"},
      {"disc { radius_m: 0.003 }", "", "wounds[0]: ", "has no shape; give one of disc, ellipse, polygon, polyline"},
      {"flow_ml_per_s: 2", "", "wounds[0]: ", "has no drive; give one of flow_ml_per_s, pressure"},
      {"radius_m: 0.003", "radius_m: 9e-6", "wounds[0].disc.radius_m: ", "value 9e-06 is out of range, allowed 1e-05 to 0.1 (m)"},
      {"radius_m: 0.003", "radius_m: 0.11", "wounds[0].disc.radius_m: ", "value 0.11"},
      {"semi_axis_u_m: 0.002", "", "wounds[1].ellipse.semi_axis_u_m: ", "value 0"},
      {"semi_axis_v_m: 0.001", "semi_axis_v_m: 1", "wounds[1].ellipse.semi_axis_v_m: ", "value 1 is out of range"},
      {"points_m { v: 0.004 }", "", "wounds[2].polygon.points_m: ", "2 points are given, allowed 3 to 256"},
      {"points_m { v: 0.004 }", repeated("points_m { v: 0.004 } ", 255), "wounds[2].polygon.points_m: ", "257 points are given"},
      {"points_m { v: 0.004 }", "points_m { v: 0.2 }", "wounds[2].polygon.points_m[2].v: ", "value 0.2 is out of range"},
      {"points_m { v: 0.004 }", "points_m { v: 1e-9 }", "wounds[2].polygon: ", "encloses 3e-12 m^2"},
      {"points_m { v: 0.004 }", "points_m { u: 0.001 }", "wounds[2].polygon: ", "folds back onto itself at point 1"},
      {"points_m { u: 0.005 }", "", "wounds[3].polyline.points_m: ", "1 points are given, allowed 2 to 256"},
      {"points_m { u: 0.005 }", "points_m { u: -0.005 }", "wounds[3].polyline: ", "points 0 and 1 coincide"},
      {"width_m: 0.0015", "", "wounds[3].polyline.width_m: ", "value 0 is out of range"},
      {"flow_ml_per_s: 2", "flow_ml_per_s: -1",
       "wounds[0].flow_ml_per_s: ", "value -1 is out of range, allowed 0 to 1000 (mL/s)"},
      {"flow_ml_per_s: 2", "flow_ml_per_s: 1001", "wounds[0].flow_ml_per_s: ", "value 1001"},
      {"inlet_pressure_mmhg: 1", "inlet_pressure_mmhg: -1",
       "wounds[1].pressure.inlet_pressure_mmhg: ", "allowed 0 to 1000 (mmHg)"},
      {"inlet_pressure_mmhg: 1", "inlet_pressure_mmhg: 1001", "wounds[1].pressure.inlet_pressure_mmhg: ", "value 1001"},
      {"discharge_coefficient: 0.7", "discharge_coefficient: 0.05",
       "wounds[1].pressure.discharge_coefficient: ", "allowed 0.1 to 1"},
      {"discharge_coefficient: 0.7", "discharge_coefficient: 1.1", "wounds[1].pressure.discharge_coefficient: ", "value 1.1"},
      {"max_wounds: 9", "max_wounds: 3", "wounds: ", "4 are given, but commands.max_wounds is 3"},
      {"wounds {", repeated("wounds { disc { radius_m: 0.001 } flow_ml_per_s: 0 }\n", 61) + "wounds {",
       "wounds: ", "65 are given, allowed are at most 64"},
      // fluid blocks
      {"upper_m { x: 0.03 y: 0.03 z: 0.02 }", "", "fluid_blocks[0].upper_m: ", "is required"},
      {"upper_m { x: 0.04 y: 0.03 z: 0.02 }", "upper_m { x: 0.06 y: 0.03 z: 0.02 }",
       "fluid_blocks[1].upper_m.x: ", "value 0.06 is outside the domain"},
      {"fluid_blocks { lower_m { x: 0.03", "fluid_blocks { lower_m { x: 0.029", "fluid_blocks[1]: ", "overlaps fluid_blocks[0]"},
      {"upper_m { x: 0.03 y: 0.03 z: 0.02 }", "upper_m { x: 0.021 y: 0.03 z: 0.02 }",
       "fluid_blocks[0]: ", "holds no particle: each side must measure at least 0.002 m"},
      {"velocity_m_per_s { x: 0.5 }", "velocity_m_per_s { x: 101 }", "fluid_blocks[0].velocity_m_per_s: ", "value 101"},
      {"jitter: 0.1", "jitter: 0.21", "fluid_blocks[0].jitter: ", "value 0.21 is out of range, allowed 0 to 0.2 (spacings)"},
      {"viscosity_pa_s: 0.006", "viscosity_pa_s: 1001", "fluid_blocks[0].viscosity_pa_s: ", "value 1001"},
      {"viscosity { viscosity_pa_s: 0.005 }", "", "fluid_blocks[0].viscosity_pa_s: ", "needs the viscosity effect"},
      {"fluid_blocks {", repeated("fluid_blocks { lower_m {} upper_m { x: 0.002 y: 0.002 z: 0.002 } }\n", 63) + "fluid_blocks {",
       "fluid_blocks: ", "65 are given, allowed are at most 64"},
      // output, commands
      {"frame_rate_hz: 30", "frame_rate_hz: 0.5", "output.frame_rate_hz: ", "allowed 1 to 1000 (frames per simulated s)"},
      {"frame_rate_hz: 30", "frame_rate_hz: 1001", "output.frame_rate_hz: ", "value 1001"},
      {"attributes: VELOCITY", "attributes: 9", "output.attributes: ", "value 9 is unknown, known are VELOCITY"},
      {"attributes: VELOCITY", "attributes: NONE", "output.attributes: ", "NONE stands beside other attributes"},
      {"viscosity { viscosity_pa_s: 0.005 }", "", "output.attributes: ", "VISCOSITY needs the viscosity effect"},
      {"instrument_expiry_s: 0.2", "instrument_expiry_s: 0.005", "commands.instrument_expiry_s: ", "allowed 0.01 to 10 (s)"},
      {"instrument_expiry_s: 0.2", "instrument_expiry_s: 11", "commands.instrument_expiry_s: ", "value 11"},
      {"max_wounds: 9", "max_wounds: 0", "commands.max_wounds: ", "value 0 is out of range, allowed 1 to 1023 (wounds)"},
      {"max_wounds: 9", "max_wounds: 1024", "commands.max_wounds: ", "value 1024"},
  };
  return kRules;
}

TEST(SceneRules, TheStartingPointIsValid) {
  const Result<SceneDescription> scene = parseScene(kFullScene);
  EXPECT_TRUE(scene.ok()) << scene.status().message();
}

TEST(SceneRules, EachBrokenRuleIsNamedWithItsPath) {
  for (const Rule& rule : rules()) {
    SCOPED_TRACE(rule.from + " -> " + rule.to.substr(0, 80));
    const Result<SceneDescription> scene = parseScene(replaced(kFullScene, rule.from, rule.to));
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.status().code(), StatusCode::invalid_argument);
    const std::string& message = scene.status().message();
    const std::size_t line = message.find("\n" + rule.path);
    ASSERT_NE(line, std::string::npos) << "no line starts with '" << rule.path << "' in\n" << message;
    bool found = false;
    for (std::size_t at = line; at != std::string::npos; at = message.find("\n" + rule.path, at + 1)) {
      found = found || message.substr(at + 1, message.find('\n', at + 1) - at - 1).find(rule.words) != std::string::npos;
    }
    EXPECT_TRUE(found) << "'" << rule.words << "' is not in\n" << message;
  }
}

TEST(SceneRules, TheEndsOfTheRangesAreAllowed) {
  const std::vector<std::pair<std::string, std::string>> allowed{
      {"slip: 0.25", "slip: 0"},
      {"slip: 0.25", "slip: 1"},
      {"support_ratio: 2.5", "support_ratio: 1.5"},
      {"support_ratio: 2.5", "support_ratio: 3.5"},
      {"capacity: 5000", "capacity: 250"},
      {"capacity: 5000", "capacity: 2000000"},
      {"max_wounds: 9", "max_wounds: 4"},
      {"max_wounds: 9", "max_wounds: 1023"},
      {"0.03 depth_m: 0.01", "0.03 depth_m: 0.03"},
      {"jitter: 0.1", "jitter: 0.2"},
      {"flow_ml_per_s: 2", "flow_ml_per_s: 0"},
      {"position_m { x: 0.01 }", "position_m { x: 0.01 z: 0.05 }"},
      {"\"full\"", quotedRun("", 64)},
      {"\"full\"", "\"Gef\\303\\244\\303\\237\""},
  };
  for (const auto& [from, to] : allowed) {
    const Result<SceneDescription> scene = parseScene(replaced(kFullScene, from, to));
    EXPECT_TRUE(scene.ok()) << to << "\n" << scene.status().message();
  }
}

}  // namespace
}  // namespace bleedsim::scene
