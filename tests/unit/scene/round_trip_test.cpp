#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "scene_text.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {
namespace {

std::string print(const sph::Vec3& v) { return fmt::format("({} {} {})", v.x(), v.y(), v.z()); }

std::string print(const std::vector<sph::Vec2>& points) {
  std::string result;
  for (const sph::Vec2& p : points) result += fmt::format("({} {})", p.x(), p.y());
  return result;
}

struct PrintShape {
  std::string operator()(const sph::PlaneShape& s) const { return "plane " + print(s.point) + print(s.normal); }
  std::string operator()(const sph::BoxShape& s) const {
    return fmt::format("box {}{} {} {}", print(s.lower), print(s.upper), s.obstacle, s.open_top);
  }
  std::string operator()(const sph::BowlShape& s) const {
    return fmt::format("bowl {} {} {}", print(s.rim_center), s.sphere_radius, s.depth);
  }
  std::string operator()(const sph::DiscPatch& s) const { return fmt::format("disc {}", s.radius); }
  std::string operator()(const sph::EllipsePatch& s) const { return fmt::format("ellipse {} {}", s.semi_axis_u, s.semi_axis_v); }
  std::string operator()(const sph::PolygonPatch& s) const { return "polygon " + print(s.points); }
  std::string operator()(const sph::PolylinePatch& s) const { return fmt::format("polyline {} {}", print(s.points), s.width); }
  std::string operator()(const sph::FlowDrive& d) const { return fmt::format("flow {}", d.flow); }
  std::string operator()(const sph::PressureDriveSettings& d) const {
    return fmt::format("pressure {} {}", d.inlet_pressure, d.discharge_coefficient);
  }
};

std::string print(const sph::EffectSettings& effects) {
  std::string result;
  if (effects.gravity) result += " gravity " + print(effects.gravity->acceleration);
  if (effects.pressure) result += fmt::format(" pressure {}", effects.pressure->background_pressure);
  if (effects.viscosity) result += fmt::format(" viscosity {}", effects.viscosity->viscosity);
  if (effects.applied_force) result += fmt::format(" applied_force {}", effects.applied_force->max_sources);
  return result;
}

/// Every member except normalized_text, numbers with all their digits.
std::string print(const SceneDescription& scene) {
  const sph::WorldDescription& w = scene.world;
  std::string out = fmt::format("{} {} {} {} {} {}\n", scene.name, scene.description, scene.frame_id, scene.frame_rate,
                                scene.attributes, scene.instrument_expiry);
  for (const std::string& effect : scene.effects) out += effect + "\n";
  out += fmt::format("{} {}{} {}{}{} {} {} {} {} {} {} {} {} {}\n", w.seed, print(w.domain.lower), print(w.domain.upper),
                     w.domain.periodic[0], w.domain.periodic[1], w.domain.periodic[2], w.capacity, w.spacing, w.support_ratio,
                     w.rest_density, w.compressibility.mach_factor, w.compressibility.design_speed,
                     w.compressibility.max_fall_or_depth, w.max_wounds, w.max_dt);
  out += print(w.effects) + "\n";
  for (const auto& t : w.tissue) out += fmt::format("tissue {} {} {}\n", t.name, std::visit(PrintShape{}, t.shape), t.slip);
  for (const auto& wound : w.wounds) {
    out += fmt::format("wound {} {}{}{} {} {}\n", wound.name, print(wound.position), print(wound.normal), print(wound.tangent),
                       std::visit(PrintShape{}, wound.shape), std::visit(PrintShape{}, wound.drive));
  }
  for (const auto& b : w.fluid_blocks) {
    out += fmt::format("block {}{}{} {} {}\n", print(b.lower), print(b.upper), print(b.velocity), b.jitter,
                       b.viscosity ? fmt::format("{}", *b.viscosity) : "default");
  }
  return out;
}

void expectRoundTrip(const SceneDescription& scene) {
  const Result<SceneDescription> again = parseScene(scene.normalized_text);
  ASSERT_TRUE(again.ok()) << again.status().message() << "\n" << scene.normalized_text;
  EXPECT_EQ(print(*again), print(scene));
  EXPECT_EQ(again->normalized_text, scene.normalized_text);
}

TEST(NormalizedText, ParsesToTheSameDescription) {
  for (const std::string_view text : {kFullScene, kLeastScene}) {
    const Result<SceneDescription> scene = parseScene(text);
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    expectRoundTrip(*scene);
  }
}

TEST(NormalizedText, OfEveryShippedSceneParsesToTheSameDescription) {
  for (const auto& entry : std::filesystem::directory_iterator{BLEEDSIM_SCENE_DIR}) {
    SCOPED_TRACE(entry.path().string());
    const Result<SceneDescription> scene = loadScene(entry.path());
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    expectRoundTrip(*scene);
  }
}

TEST(NormalizedText, KeepsEveryDigitAndCharacter) {
  const Result<SceneDescription> scene =
      parseScene(replaced(replaced(kFullScene, "spacing_m: 0.002", "spacing_m: 0.0020000000000000004"), "\"full\"",
                          "\"Gef\\303\\244\\303\\237 \\\"A\\\"\""));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->world.spacing, 0.0020000000000000004);
  EXPECT_NE(scene->normalized_text.find("Gef\xc3\xa4\xc3\x9f"), std::string::npos) << scene->normalized_text;
  expectRoundTrip(*scene);
}

TEST(NormalizedText, IsTheSameForTheSameScene) {
  const Result<SceneDescription> least = parseScene(kLeastScene);
  // The least scene with its defaults spelled out, in another order, with comments and a negative zero.
  const Result<SceneDescription> spelled = parseScene(R"(
commands { max_wounds: 64 instrument_expiry_s: 0.1 }   # a comment
output: < frame_rate_hz: 6e1, attributes: [NONE] >
compressibility { design_speed_m_per_s: 0.30 mach_factor: 10 }
fluid { density_kg_per_m3: 1060.0 } effects {}
frame_id: "bleed" "sim" seed: 1
resolution { support_ratio: 2 spacing_m: 2e-3 }
domain { capacity: 10 upper_m { x: 0.1 y: 0.1 z: 0.1 } lower_m { x: -0.0 y: 0 } periodic_x: false })");
  ASSERT_TRUE(least.ok()) << least.status().message();
  ASSERT_TRUE(spelled.ok()) << spelled.status().message();
  EXPECT_EQ(least->normalized_text, spelled->normalized_text);
}

TEST(NormalizedText, AttributesAreSortedAndStandOnce) {
  const auto text_of = [](const std::string& attributes) {
    const Result<SceneDescription> scene = parseScene(std::string{kLeastScene} + "output { attributes: " + attributes + " }");
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    return scene.ok() ? scene->normalized_text : attributes;
  };
  EXPECT_EQ(text_of("[DENSITY, VELOCITY, DENSITY]"), text_of("[VELOCITY, DENSITY]"));
}

}  // namespace
}  // namespace bleedsim::scene
