#include "service/scene/change_effect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "effects_text.h"
#include "scene_text.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

SceneDescription parsed(const std::string& text) {
  Result<SceneDescription> scene = parseScene(text);
  EXPECT_TRUE(scene.ok()) << scene.status().message();
  return scene.ok() ? *scene : SceneDescription{};
}

SceneDescription changed(const SceneDescription& scene, const EffectChange& change, std::optional<double> speed_of_sound = {}) {
  Result<SceneDescription> result =
      changeEffect(scene, change, {.speed_of_sound = speed_of_sound.value_or(sph::speedOfSound(scene.world))});
  EXPECT_TRUE(result.ok()) << change.name << ": " << result.status().message();
  return result.ok() ? *result : scene;
}

Status refusal(const SceneDescription& scene, const EffectChange& change) {
  const Status status = changeEffect(scene, change, {.speed_of_sound = sph::speedOfSound(scene.world)}).status();
  EXPECT_FALSE(status.ok());
  return status;
}

TEST(ChangeEffect, SwitchesOffAndOnAgainWithTheFormerSettings) {
  const SceneDescription start = parsed(std::string{kEffectScene});
  const SceneDescription off = changed(start, {"repulsion", false, ""});
  EXPECT_FALSE(off.world.effects.repulsion.has_value());
  EXPECT_THAT(off.effects, Not(Contains("repulsion")));
  EXPECT_THAT(off.normalized_text, Not(HasSubstr("repulsion")));
  const SceneDescription on = changed(off, {"repulsion", true, ""});
  EXPECT_EQ(on.world.effects.repulsion->strength, 1.2);
  EXPECT_EQ(on.normalized_text, start.normalized_text);
}

TEST(ChangeEffect, TakesSettingsAndFillsTheRestWithDefaults) {
  const SceneDescription start = parsed(std::string{kLeastScene});
  const SceneDescription on = changed(start, {"viscosity", true, "viscosity_pa_s: 0.02"});
  EXPECT_EQ(on.world.effects.viscosity->viscosity, 0.02);
  EXPECT_EQ(on.world.effects.viscosity->max_iterations, 100);
  const SceneDescription other = changed(on, {"viscosity", true, "casson {}"});
  EXPECT_TRUE(std::holds_alternative<sph::CassonRheology>(other.world.effects.viscosity->rheology));
  const SceneDescription again = changed(changed(other, {"viscosity", false, ""}), {"viscosity", true, ""});
  EXPECT_TRUE(std::holds_alternative<sph::CassonRheology>(again.world.effects.viscosity->rheology)) << "the last ones that acted";
  EXPECT_EQ(changed(start, {"repulsion", true, ""}).world.effects.repulsion->strength, 1.5);
}

TEST(ChangeEffect, RefusesWithTheFieldAndTheReason) {
  const SceneDescription start = parsed(std::string{kEffectScene});
  const Status unknown = refusal(start, {"stickiness", true, ""});
  EXPECT_EQ(unknown.code(), StatusCode::not_found);
  EXPECT_THAT(unknown.message(), AllOf(HasSubstr("no such effect"), HasSubstr("surface_tension"), HasSubstr("adhesion")));
  EXPECT_LE(unknown.message().size(), 127u) << "a reply has no more room";
  EXPECT_THAT(refusal(start, {"platelet", true, ""}).message(), HasSubstr("did you mean 'platelets'?"));
  EXPECT_EQ(refusal(start, {"auto", true, ""}).code(), StatusCode::not_found);
  const Status range = refusal(start, {"repulsion", true, "strength: 99"});
  EXPECT_EQ(range.code(), StatusCode::invalid_argument);
  EXPECT_EQ(range.message(), "effects.repulsion.strength: value 99 is out of range, allowed 0 to 10 (1)");
  EXPECT_THAT(refusal(start, {"repulsion", true, "strenght: 1"}).message(), HasSubstr("did you mean 'strength'?"));
  EXPECT_THAT(refusal(start, {"repulsion", true, "strength: nan"}).message(), HasSubstr("not finite"));
  EXPECT_THAT(refusal(start, {"repulsion", true, "} gravity {"}).message(), HasSubstr("line 1:1"));
  EXPECT_THAT(refusal(start, {"repulsion", false, "strength: 1"}).message(), HasSubstr("leave them out"));
}

TEST(ChangeEffect, RefusesWhatCannotWorkTogether) {
  const SceneDescription start = parsed(std::string{kEffectScene});
  EXPECT_THAT(refusal(start, {"viscosity", false, ""}).message(), HasSubstr("effects.platelets: needs viscosity"));
  const SceneDescription bare = parsed(std::string{kLeastScene});
  EXPECT_THAT(refusal(bare, {"adhesion", true, ""}).message(), HasSubstr("needs tissue"));
  const SceneDescription spline = parsed(replaced(kLeastScene, "spacing_m: 0.002", "spacing_m: 0.002 kernel: CUBIC_SPLINE"));
  EXPECT_THAT(refusal(spline, {"core_radius", true, ""}).message(), HasSubstr("WENDLAND_C2"));
}

TEST(ChangeEffect, TakesWhatDependsOnAnEffectAlongWithIt) {
  const SceneDescription start = parsed(std::string{kFullScene});
  const SceneDescription off = changed(start, {"viscosity", false, ""});
  EXPECT_EQ(off.attributes, static_cast<std::uint32_t>(sph::kFrameVelocity));
  EXPECT_FALSE(off.world.fluid_blocks[0].viscosity.has_value());
  const SceneDescription effects = parsed(std::string{kEffectScene});
  EXPECT_EQ(changed(effects, {"platelets", false, ""}).attributes, sph::kFrameViscosity | sph::kFrameRadius);
  EXPECT_EQ(changed(effects, {"core_radius", false, ""}).attributes, sph::kFrameViscosity | sph::kFramePlatelet);
}

TEST(ChangeEffect, AHandOverrulesAuto) {
  const SceneDescription start = parsed(replaced(kEffectScene, "horizon_s: 20", "horizon_s: 0.001"));
  ASSERT_FALSE(start.world.effects.platelets.has_value());
  const SceneDescription on = changed(start, {"platelets", true, ""});
  EXPECT_TRUE(on.world.effects.platelets.has_value());
  EXPECT_EQ(on.world.effects.platelets->clot_speedup, 50.0);
  EXPECT_THAT(on.decisions, testing::IsEmpty());
}

// The explicit limit is 0.045 h^2 rho/mu = 0.045 (4 mm)^2 1060/1.5 = 0.51 ms; 0.4 dx/c0 is 0.27 ms at the scene's 3 m/s and 0.8
// ms at 1 m/s, at which a session may run that began without gravity's fall or a wound's pressure.
TEST(ChangeEffect, AutoDecidesByTheSpeedOfSoundThatTheSessionRunsAt) {
  const SceneDescription start =
      parsed(std::string{kLeastScene} + "effects { viscosity { viscosity_pa_s: 1.5 } auto: \"implicit_viscosity\" }");
  ASSERT_NEAR(sph::speedOfSound(start.world), 3.0, 1e-9);
  ASSERT_EQ(start.world.effects.viscosity->solve, sph::ViscositySolve::explicit_);
  const EffectChange gravity{"gravity", true, ""};
  const SceneDescription same = changed(start, gravity, 3.0);
  EXPECT_EQ(same.world.effects.viscosity->solve, sph::ViscositySolve::explicit_);
  EXPECT_THAT(same.decisions, ElementsAre(HasSubstr("implicit_viscosity off: the explicit limit, 0.509 ms")));
  const SceneDescription slower = changed(start, gravity, 1.0);
  EXPECT_EQ(slower.world.effects.viscosity->solve, sph::ViscositySolve::automatic);
  EXPECT_THAT(slower.decisions, ElementsAre(AllOf(HasSubstr("implicit_viscosity on"), HasSubstr("0.8 ms"))));
}

}  // namespace
}  // namespace bleedsim::scene
