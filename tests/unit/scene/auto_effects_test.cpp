// The decisions of effects.auto against figures worked out by hand.
#include "service/scene/auto_effects.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effects_text.h"
#include "scene_text.h"
#include "service/scene/change_effect.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// l_c = sqrt(0.0526/(1060 x 9.81)) = 2.249 mm, three of them 6.747 mm.
sph::WorldDescription withWound(double radius) {
  sph::WorldDescription world;
  world.effects.gravity.emplace();
  world.effects.surface_tension.emplace();
  world.wounds.push_back({.name = "a", .shape = sph::DiscPatch{radius}});
  return world;
}

TEST(DecideTension, ComparesTheSmallestFeatureWithThreeCapillaryLengths) {
  const AutoDecision small = decideTension(withWound(0.00337));
  EXPECT_TRUE(small.enabled) << small.reason;
  EXPECT_THAT(small.reason, HasSubstr("wounds[0] of 6.74 mm, is within 3 capillary lengths, 6.75 mm"));
  const AutoDecision large = decideTension(withWound(0.00338));
  EXPECT_FALSE(large.enabled);
  EXPECT_THAT(large.reason, HasSubstr("wounds[0] of 6.76 mm, is above 3 capillary lengths, 6.75 mm"));
}

TEST(DecideTension, LooksAtEveryKindOfFeature) {
  const auto with = [](const auto& add) {
    sph::WorldDescription world = withWound(0.05);
    add(world);
    return decideTension(world).enabled;
  };
  EXPECT_FALSE(with([](auto&) {}));
  EXPECT_TRUE(with([](auto& w) { w.wounds[0].shape = sph::EllipsePatch{0.05, 0.003}; }));
  EXPECT_TRUE(with([](auto& w) { w.wounds[0].shape = sph::PolylinePatch{{{0, 0}, {0.1, 0}}, 0.002}; }));
  EXPECT_TRUE(with([](auto& w) { w.wounds[0].shape = sph::PolygonPatch{{{0, 0}, {0.1, 0}, {0.1, 0.006}}}; }));
  EXPECT_TRUE(with([](auto& w) {
    w.fluid_blocks.push_back({.lower = {0, 0, 0}, .upper = {0.05, 0.05, 0.004}, .viscosity = {}, .platelet = {}});
  }));
  EXPECT_TRUE(with([](auto& w) {
    w.tissue.push_back({.name = "b", .shape = sph::BoxShape{.lower = {0, 0, 0}, .upper = {0.1, 0.1, 0.005}}});
  }));
  EXPECT_TRUE(with([](auto& w) { w.tissue.push_back({.name = "o", .shape = sph::BowlShape{{0, 0, 0}, 0.1, 0.006}}); }));
  EXPECT_FALSE(with([](auto& w) { w.tissue.push_back({.name = "p", .shape = sph::PlaneShape{}}); }));
}

TEST(DecideTension, TakesWoundsByCommandIntoAccount) {
  EXPECT_FALSE(decideTension(withWound(0.05), 0.0068).enabled);
  const AutoDecision narrow = decideTension(withWound(0.05), 0.001);
  EXPECT_TRUE(narrow.enabled);
  EXPECT_THAT(narrow.reason, HasSubstr("a wound by command of 1 mm, is within"));
}

TEST(DecideTension, JudgesASlitByItsWidthWhateverItsDirection) {
  sph::WorldDescription world = withWound(0.05);
  world.wounds[0].shape = sph::PolygonPatch{{{0.0, 0.0}, {0.0007, 0.0}, {0.0207, 0.02}, {0.02, 0.02}}};
  const AutoDecision slit = decideTension(world);
  EXPECT_TRUE(slit.enabled) << slit.reason;
  EXPECT_THAT(slit.reason, HasSubstr("wounds[0] of 0.495 mm"));  // 0.7 mm/sqrt 2
}

TEST(DecideTension, StaysOnWithoutGravityOrFeature) {
  sph::WorldDescription weightless = withWound(0.05);
  weightless.effects.gravity.reset();
  EXPECT_TRUE(decideTension(weightless).enabled);
  sph::WorldDescription nothing = withWound(0.05);
  nothing.wounds.clear();
  EXPECT_TRUE(decideTension(nothing).enabled);
}

TEST(DecidePlatelets, ComparesTheHorizonWithTheClottingTime) {
  sph::WorldDescription world;
  world.effects.platelets.emplace();
  // Without tissue and air: t50 = ln 99/r = 4.595/0.0153 = 300.3 s.
  world.effects.platelets->wall_rate = 0.0;
  world.effects.platelets->air_rate = 0.0;
  EXPECT_FALSE(decidePlatelets(world, 2.9).enabled);
  const AutoDecision on = decidePlatelets(world, 3.1);
  EXPECT_TRUE(on.enabled);
  EXPECT_THAT(on.reason, HasSubstr("3.1 s, is at least 1 % of the shortest clotting time, 300 s"));
  world.effects.platelets->clot_speedup = 100.0;
  EXPECT_FALSE(decidePlatelets(world, 0.029).enabled);
  EXPECT_TRUE(decidePlatelets(world, 0.031).enabled);
}

TEST(DecidePlatelets, TheFastestPlaceTouchesTissueAndAir) {
  // dP/dt = -P (c - r P), c = 0.0273, r = 0.0153, from 0.99 to 0.5: integrated here by Euler's rule in 1e-3 s.
  double p = 0.99;
  double time = 0.0;
  for (; p > 0.5; time += 1e-3) p -= 1e-3 * p * (0.0273 - 0.0153 * p);
  sph::WorldDescription world;
  world.effects.platelets.emplace();
  EXPECT_FALSE(decidePlatelets(world, 0.0099 * time).enabled);
  EXPECT_TRUE(decidePlatelets(world, 0.0101 * time).enabled);
}

TEST(DecidePlatelets, WithoutARateNothingClots) {
  sph::WorldDescription world;
  world.effects.platelets.emplace();
  world.effects.platelets->clot_speedup = 0.0;
  EXPECT_FALSE(decidePlatelets(world, 1e6).enabled);
}

/// dx 2 mm, h 4 mm, c0 4 m/s: acoustic 0.2 ms; explicit 0.045 h^2 rho/mu = 7.632e-4/mu.
sph::WorldDescription viscous(double viscosity) {
  sph::WorldDescription world;
  world.spacing = 0.002;
  world.compressibility.design_speed = 0.4;
  world.effects.viscosity.emplace();
  world.effects.viscosity->viscosity = viscosity;
  return world;
}

TEST(DecideImplicitViscosity, ComparesTheExplicitLimitWithTheOthers) {
  EXPECT_FALSE(decideImplicitViscosity(viscous(3.8), 4.0).enabled);
  const AutoDecision on = decideImplicitViscosity(viscous(3.9), 4.0);
  EXPECT_TRUE(on.enabled);
  EXPECT_THAT(on.reason, HasSubstr("the explicit limit, 0.196 ms, is below the next one, 0.2 ms"));
  sph::WorldDescription short_steps = viscous(3.9);
  short_steps.max_dt = 1e-4;
  EXPECT_FALSE(decideImplicitViscosity(short_steps, 4.0).enabled);
  sph::WorldDescription repelled = viscous(3.9);
  repelled.effects.repulsion.emplace();  // 0.1 dx/c0 = 0.05 ms
  EXPECT_FALSE(decideImplicitViscosity(repelled, 4.0).enabled);
}

// The solver's own limits: those of the smallest reach, of harder contacts and of platelets.
TEST(DecideImplicitViscosity, KnowsTheLimitsOfTheOtherEffects) {
  // A quarter of the limit with half the reach: 0.25 x 7.632e-4/mu is below 0.2 ms from 0.954 Pa s on.
  sph::WorldDescription shrunk = viscous(0.96);
  EXPECT_FALSE(decideImplicitViscosity(shrunk, 4.0).enabled);
  shrunk.effects.core_radius = sph::CoreRadiusSettings{.smallest = 0.5};
  EXPECT_TRUE(decideImplicitViscosity(shrunk, 4.0).enabled);
  shrunk.effects.viscosity->viscosity = 0.95;
  EXPECT_FALSE(decideImplicitViscosity(shrunk, 4.0).enabled);
  // Contacts four times as stiff: 0.1/2 dx/c0 = 0.025 ms, which 7.632e-4/mu is below from 30.5 Pa s on; 0.05 ms from 15.3.
  sph::WorldDescription hard = viscous(20.0);
  hard.effects.repulsion.emplace();
  EXPECT_TRUE(decideImplicitViscosity(hard, 4.0).enabled);
  hard.effects.repulsion->strength *= 4.0;
  EXPECT_FALSE(decideImplicitViscosity(hard, 4.0).enabled);
  // 0.045 h^2/k = 7.2e-7/k = 0.1 ms of platelets, which 7.632e-4/mu is below from 7.6 Pa s on.
  sph::WorldDescription spreading = viscous(5.0);
  EXPECT_TRUE(decideImplicitViscosity(spreading, 4.0).enabled);
  spreading.effects.platelets = sph::PlateletSettings{.diffusivity = 7.2e-3, .clot_viscosity = 6.0};
  EXPECT_FALSE(decideImplicitViscosity(spreading, 4.0).enabled);
}

TEST(DecideImplicitViscosity, LooksAtTheThickestBlood) {
  sph::WorldDescription clotting = viscous(0.004);
  EXPECT_FALSE(decideImplicitViscosity(clotting, 4.0).enabled);
  clotting.effects.platelets.emplace();
  EXPECT_TRUE(decideImplicitViscosity(clotting, 4.0).enabled) << "a clot of 10 Pa s";
  sph::WorldDescription block = viscous(0.004);
  block.fluid_blocks.push_back({.viscosity = 5.0, .platelet = {}});
  EXPECT_TRUE(decideImplicitViscosity(block, 4.0).enabled);
  sph::WorldDescription casson = viscous(0.004);
  // At rest mu = (sqrt(mu_c) + sqrt(tau_y/g_r))^2 = (0.0592 + 2)^2 = 4.24 Pa s.
  casson.effects.viscosity->rheology = sph::CassonRheology{.yield_stress = 0.4};
  EXPECT_TRUE(decideImplicitViscosity(casson, 4.0).enabled);
}

TEST(ApplyAuto, LeavesOutOnlyWhatItWasAskedAbout) {
  sph::WorldDescription world = withWound(0.05);
  world.effects.viscosity.emplace();
  EXPECT_THAT(applyAuto({}, {}, {}, world), IsEmpty());
  EXPECT_TRUE(world.effects.surface_tension.has_value());
  const auto decisions = applyAuto(autoNames(), {}, {}, world);
  ASSERT_EQ(decisions.size(), 2u) << "there are no platelets";
  EXPECT_FALSE(world.effects.surface_tension.has_value());
  EXPECT_EQ(world.effects.viscosity->solve, sph::ViscositySolve::explicit_);
}

TEST(ParseScene, KeepsWhatWouldBringTensionBack) {
  const std::string text = std::string{kLeastScene} + "effects { gravity {} surface_tension {} auto: 'surface_tension' }" +
                           "fluid_blocks { lower_m { z: 0.01 } upper_m { x: 0.02 y: 0.02 z: 0.03 } }";
  const Result<SceneDescription> off = parseScene(replaced(text, "capacity: 10", "capacity: 2000"));
  ASSERT_TRUE(off.ok()) << off.status().message();
  EXPECT_THAT(off->effects, testing::ElementsAre("gravity"));
  EXPECT_NEAR(off->tension_below, 3.0 * std::sqrt(0.0526 / (1060.0 * 9.81)), 1e-12);
  const Result<SceneDescription> on = decideAgain(*off, {3.0, 0.001});
  ASSERT_TRUE(on.ok()) << on.status().message();
  EXPECT_THAT(on->effects, testing::ElementsAre("gravity", "surface_tension"));
  EXPECT_EQ(on->tension_below, 0.0);
  EXPECT_THAT(on->decisions,
              testing::ElementsAre(HasSubstr("auto: surface_tension on: the smallest feature, a wound by command")));
  EXPECT_EQ(on->normalized_text, off->normalized_text);
  // Another effect is switched by hand: the wound is not forgotten.
  const Result<SceneDescription> later = changeEffect(*on, {"pressure", true, ""}, {3.0, 0.001});
  ASSERT_TRUE(later.ok()) << later.status().message();
  EXPECT_THAT(later->effects, testing::Contains("surface_tension"));
}

TEST(ParseScene, TellsItsDecisions) {
  std::string text = replaced(kEffectScene, "auto: \"platelets\"", "auto: [\"surface_tension\", \"platelets\"]");
  text = replaced(text, "horizon_s: 20", "horizon_s: 0.001");
  const Result<SceneDescription> scene = parseScene(text);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  ASSERT_EQ(scene->decisions.size(), 2u);
  EXPECT_THAT(scene->decisions[0], HasSubstr("auto: surface_tension on: the smallest feature"));
  EXPECT_THAT(scene->decisions[1], HasSubstr("auto: platelets off: the horizon, 0.001 s"));
  EXPECT_FALSE(scene->world.effects.platelets.has_value());
  EXPECT_THAT(scene->effects, testing::Not(testing::Contains("platelets")));
  EXPECT_EQ(scene->attributes & sph::kFramePlatelet, 0u);
  EXPECT_THAT(scene->normalized_text, HasSubstr("platelets {")) << "the text stays as it was written";
}

}  // namespace
}  // namespace bleedsim::scene
