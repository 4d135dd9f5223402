// The effects of a scene: values in SI units, defaults, and one row for each rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "effects_text.h"
#include "scene_text.h"
#include "service/scene/effect_names.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SceneEffects, ConvertToSiUnits) {
  const Result<SceneDescription> scene = parseScene(kEffectScene);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_THAT(scene->effects, ElementsAre("gravity", "pressure", "viscosity", "applied_force", "surface_tension", "platelets",
                                          "core_radius", "repulsion", "adhesion"));
  EXPECT_EQ(scene->attributes, sph::kFrameViscosity | sph::kFramePlatelet | sph::kFrameRadius);
  const sph::EffectSettings& e = scene->world.effects;
  EXPECT_EQ(scene->world.kernel, sph::KernelType::wendland_c2);
  EXPECT_EQ(e.pressure->form, sph::PressureForm::symmetric);
  EXPECT_EQ(e.viscosity->solve, sph::ViscositySolve::implicit);
  EXPECT_EQ(e.viscosity->solve_tolerance, 0.02);
  EXPECT_EQ(e.viscosity->max_iterations, 50);
  const auto& law = std::get<sph::CarreauYasudaRheology>(e.viscosity->rheology);
  EXPECT_EQ(law.zero_shear, 0.06);
  EXPECT_EQ(law.infinite_shear, 0.004);
  EXPECT_EQ(law.time, 3.5);
  EXPECT_EQ(law.power, 0.4);
  EXPECT_EQ(law.transition, 1.9);
  EXPECT_EQ(e.viscosity->viscosity, 0.004);
  // (70.105 - 0.473 x 37) mN/m; 12 digits: decimal to binary.
  EXPECT_NEAR(e.surface_tension->coefficient, 0.052604, 1e-12);
  EXPECT_EQ(e.surface_tension->normal_cutoff, 0.4);
  EXPECT_NEAR(*e.surface_tension->contact_angle, 0.69813170079773, 1e-12);
  EXPECT_EQ(e.platelets->fresh, 0.98);
  EXPECT_EQ(e.platelets->diffusivity, 2e-9);
  EXPECT_EQ(e.platelets->activation_rate, 0.02);
  EXPECT_EQ(e.platelets->wall_rate, 0.03);
  EXPECT_EQ(e.platelets->air_rate, 0.004);
  EXPECT_EQ(e.platelets->shear_gate, 300.0);
  EXPECT_EQ(e.platelets->clot_viscosity, 9.0);
  EXPECT_EQ(e.platelets->clot_speedup, 50.0);
  EXPECT_EQ(e.core_radius->smallest, 0.8);
  EXPECT_EQ(e.core_radius->largest, 1.2);
  EXPECT_EQ(e.core_radius->relaxation, 0.2);
  EXPECT_EQ(e.repulsion->strength, 1.2);
  EXPECT_EQ(e.repulsion->contact_distance, 0.85);
  EXPECT_EQ(e.repulsion->power_1, 7);
  EXPECT_EQ(e.repulsion->power_2, 3);
  EXPECT_EQ(e.repulsion->damping, 0.5);
  EXPECT_EQ(e.adhesion->acceleration, 6.0);
}

TEST(SceneEffects, AnotherFormOfEachChoice) {
  std::string text = replaced(kEffectScene, "temperature_c: 37", "sigma_n_per_m: 0.07");
  text = replaced(text, "form: SYMMETRIC", "form: VARIATIONAL");
  text = replaced(text, "solve: IMPLICIT", "solve: EXPLICIT");
  text =
      replaced(text, "carreau_yasuda { zero_shear_pa_s: 0.06 infinite_shear_pa_s: 0.004 time_s: 3.5 power: 0.4 transition: 1.9 }",
               "casson { yield_stress_pa: 0.006 plastic_viscosity_pa_s: 0.004 regularisation_shear_rate_per_s: 0.2 }");
  const Result<SceneDescription> scene = parseScene(text);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const sph::EffectSettings& e = scene->world.effects;
  EXPECT_EQ(e.surface_tension->coefficient, 0.07);
  EXPECT_EQ(e.pressure->form, sph::PressureForm::variational);
  EXPECT_EQ(e.viscosity->solve, sph::ViscositySolve::explicit_);
  const auto& law = std::get<sph::CassonRheology>(e.viscosity->rheology);
  EXPECT_EQ(law.yield_stress, 0.006);
  EXPECT_EQ(law.viscosity, 0.004);
  EXPECT_EQ(law.regularisation_shear_rate, 0.2);
}

TEST(SceneEffects, EmptyMessagesTakeTheSolversDefaults) {
  const Result<SceneDescription> scene =
      parseScene(std::string{kLeastScene} +
                 "effects { pressure {} viscosity {} surface_tension {} platelets {} core_radius {} repulsion {} adhesion {} }"
                 "tissue { plane { normal { z: 1 } } }");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const sph::EffectSettings& e = scene->world.effects;
  EXPECT_EQ(e.pressure->form, sph::PressureForm::variational);
  EXPECT_TRUE(std::holds_alternative<sph::NewtonianRheology>(e.viscosity->rheology));
  EXPECT_EQ(e.viscosity->solve, sph::ViscositySolve::automatic);
  EXPECT_EQ(e.viscosity->max_iterations, 100);
  EXPECT_EQ(e.surface_tension->coefficient, 0.0526);
  EXPECT_FALSE(e.surface_tension->contact_angle.has_value());
  EXPECT_EQ(e.platelets->fresh, 0.99);
  EXPECT_EQ(e.platelets->activation_rate, 0.0153);
  EXPECT_EQ(e.core_radius->largest, 1.3);
  EXPECT_EQ(e.repulsion->contact_distance, 0.9);
  EXPECT_EQ(e.adhesion->acceleration, 5.0);
}

TEST(SceneEffects, TheCubicSplineStaysExplicit) {
  const Result<SceneDescription> scene =
      parseScene(replaced(kLeastScene, "spacing_m: 0.002", "spacing_m: 0.002 kernel: CUBIC_SPLINE") +
                 "effects { gravity {} pressure {} viscosity {} applied_force {} }");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->world.kernel, sph::KernelType::cubic_spline);
  EXPECT_EQ(scene->world.effects.viscosity->solve, sph::ViscositySolve::explicit_);
}

TEST(SceneEffects, RoundTripThroughTheNormalisedText) {
  const Result<SceneDescription> scene = parseScene(kEffectScene);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const Result<SceneDescription> again = parseScene(scene->normalized_text);
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(again->normalized_text, scene->normalized_text);
  EXPECT_EQ(again->world.effects.platelets->clot_speedup, 50.0);
  EXPECT_EQ(again->world.effects.surface_tension->coefficient, scene->world.effects.surface_tension->coefficient);
  EXPECT_EQ(again->decisions, scene->decisions);
}

TEST(SceneEffects, AreNamedAsTheSolverNamesThem) {
  std::vector<std::string> known = knownEffects();
  known.insert(known.end(), {"wetting", "slip"});  // by settings of others
  for (const sph::EffectInfo& row : sph::effectCatalog()) {
    EXPECT_THAT(known, testing::Contains(std::string{row.name})) << "an effect of the solver that no scene can ask for";
  }
}

struct Rule {
  std::string from;
  std::string to;
  std::string problem;  ///< path and words
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> kRules{
      {"form: SYMMETRIC", "form: 7", "effects.pressure.form: value 7 is unknown, known are VARIATIONAL, SYMMETRIC"},
      {"zero_shear_pa_s: 0.06", "zero_shear_pa_s: 0",
       "effects.viscosity.carreau_yasuda.zero_shear_pa_s: value 0 is out of range, allowed 1e-05 to 1000 (Pa s)"},
      {"zero_shear_pa_s: 0.06", "zero_shear_pa_s: 0.003",
       "effects.viscosity.carreau_yasuda.infinite_shear_pa_s: value 0.004 is above zero_shear_pa_s, 0.003"},
      {"infinite_shear_pa_s: 0.004", "infinite_shear_pa_s: nan",
       "effects.viscosity.carreau_yasuda.infinite_shear_pa_s: value nan is not finite"},
      {"time_s: 3.5", "time_s: -1",
       "effects.viscosity.carreau_yasuda.time_s: value -1 is out of range, allowed 1e-06 to 10000 (s)"},
      {"power: 0.4", "power: 1.5", "effects.viscosity.carreau_yasuda.power: value 1.5 is out of range, allowed 0.05 to 1 (1)"},
      {"transition: 1.9", "transition: 0", "effects.viscosity.carreau_yasuda.transition: value 0 is out of range"},
      {"carreau_yasuda { zero_shear_pa_s: 0.06 infinite_shear_pa_s: 0.004 time_s: 3.5 power: 0.4 transition: 1.9 }",
       "casson { yield_stress_pa: -1 }",
       "effects.viscosity.casson.yield_stress_pa: value -1 is out of range, allowed 0 to 100 (Pa)"},
      {"carreau_yasuda { zero_shear_pa_s: 0.06 infinite_shear_pa_s: 0.004 time_s: 3.5 power: 0.4 transition: 1.9 }",
       "casson { plastic_viscosity_pa_s: 0 }", "effects.viscosity.casson.plastic_viscosity_pa_s: value 0 is out of range"},
      {"carreau_yasuda { zero_shear_pa_s: 0.06 infinite_shear_pa_s: 0.004 time_s: 3.5 power: 0.4 transition: 1.9 }",
       "casson { regularisation_shear_rate_per_s: 0 }",
       "effects.viscosity.casson.regularisation_shear_rate_per_s: value 0 is out of range, allowed 0.001 to 100 (1/s)"},
      {"solve: IMPLICIT", "solve: 5", "effects.viscosity.solve: value 5 is unknown, known are AUTOMATIC, EXPLICIT, IMPLICIT"},
      {"solve_tolerance: 0.02", "solve_tolerance: 0", "effects.viscosity.solve_tolerance: value 0 is out of range"},
      {"max_iterations: 50", "max_iterations: 1001",
       "effects.viscosity.max_iterations: value 1001 is out of range, allowed 1 to 1000"},
      {"temperature_c: 37", "temperature_c: 100",
       "effects.surface_tension.temperature_c: value 100 is out of range, allowed 0 to 60 (degrees C)"},
      {"temperature_c: 37", "sigma_n_per_m: 52.6",
       "effects.surface_tension.sigma_n_per_m: value 52.6 is out of range, allowed 1e-05 to 1 (N/m)"},
      {"temperature_c: 37", "sigma_n_per_m: 0", "effects.surface_tension.sigma_n_per_m: value 0 is out of range"},
      {"normal_cutoff: 0.4", "normal_cutoff: 0",
       "effects.surface_tension.normal_cutoff: value 0 is out of range, allowed 0.01 to 3"},
      {"contact_angle_deg: 40", "contact_angle_deg: 181",
       "effects.surface_tension.contact_angle_deg: value 181 is out of range, allowed 0 to 180 (degrees)"},
      {"fresh: 0.98", "fresh: 1.1", "effects.platelets.fresh: value 1.1 is out of range, allowed 0 to 1"},
      {"diffusivity_m2_per_s: 2e-9", "diffusivity_m2_per_s: 1",
       "effects.platelets.diffusivity_m2_per_s: value 1 is out of range"},
      {"activation_rate_per_s: 0.02", "activation_rate_per_s: -1", "effects.platelets.activation_rate_per_s: value -1"},
      {"wall_rate_per_s: 0.03", "wall_rate_per_s: 101", "effects.platelets.wall_rate_per_s: value 101 is out of range"},
      {"air_rate_per_s: 0.004", "air_rate_per_s: inf", "effects.platelets.air_rate_per_s: value inf is not finite"},
      {"shear_gate_per_s: 300", "shear_gate_per_s: 0", "effects.platelets.shear_gate_per_s: value 0 is out of range"},
      {"clot_viscosity_pa_s: 9", "clot_viscosity_pa_s: 1001",
       "effects.platelets.clot_viscosity_pa_s: value 1001 is out of range"},
      {"clot_viscosity_pa_s: 9", "clot_viscosity_pa_s: 0.05",
       "effects.platelets.clot_viscosity_pa_s: value 0.05 is below fresh blood's, 0.06"},
      {"clot_speedup: 50", "clot_speedup: -1", "effects.platelets.clot_speedup: value -1 is out of range"},
      {"smallest: 0.8", "smallest: 0.4", "effects.core_radius.smallest: value 0.4 is out of range, allowed 0.5 to 1"},
      {"largest: 1.2", "largest: 1.6", "effects.core_radius.largest: value 1.6 is out of range, allowed 1 to 1.5"},
      {"relaxation: 0.2", "relaxation: 0", "effects.core_radius.relaxation: value 0 is out of range"},
      {"y: -0.05", "y: 0.0325", "effects.core_radius.largest: three of its reaches are 0.018 m, the periodic side y is 0.0175 m"},
      {"strength: 1.2", "strength: 11", "effects.repulsion.strength: value 11 is out of range, allowed 0 to 10"},
      {"contact_distance: 0.85", "contact_distance: 1.01",
       "effects.repulsion.contact_distance: value 1.01 is out of range, allowed 0.1 to 1 (spacings)"},
      {"power_1: 7", "power_1: 3", "effects.repulsion.power_1: value 3 must be above power_2, 3"},
      {"power_1: 7", "power_1: 13", "effects.repulsion.power_1: value 13 is out of range, allowed 1 to 12"},
      {"power_2: 3", "power_2: 0", "effects.repulsion.power_2: value 0 is out of range"},
      {"damping: 0.5", "damping: -0.1", "effects.repulsion.damping: value -0.1 is out of range"},
      {"acceleration_m_per_s2: 6", "acceleration_m_per_s2: -6",
       "effects.adhesion.acceleration_m_per_s2: value -6 is out of range"},
      // combinations
      {"tissue { plane { normal { z: 1 } } }", "", "effects.adhesion: needs tissue"},
      {"tissue { plane { normal { z: 1 } } }", "", "effects.surface_tension.contact_angle_deg: needs tissue"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.surface_tension: needs kernel WENDLAND_C2, because its factor and cut-off are fitted with it"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.platelets: needs kernel WENDLAND_C2, because the spline's sums are built without it"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.core_radius: needs kernel WENDLAND_C2, because the spline's sums are built without it"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.repulsion: needs kernel WENDLAND_C2, because the spline's sums are built without it"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.viscosity.carreau_yasuda: needs kernel WENDLAND_C2, because the shear rate is summed with it"},
      {"kernel: WENDLAND_C2", "kernel: CUBIC_SPLINE",
       "effects.viscosity.solve: needs kernel WENDLAND_C2, because the implicit sweeps are made for it"},
      {"kernel: WENDLAND_C2", "kernel: 4", "resolution.kernel: value 4 is unknown, known are WENDLAND_C2, CUBIC_SPLINE"},
      // output
      {"core_radius { smallest: 0.8 largest: 1.2 relaxation: 0.2 }", "",
       "output.attributes: RADIUS needs the core_radius effect"},
      {"attributes: RADIUS", "attributes: 9",
       "output.attributes: value 9 is unknown, known are VELOCITY, DENSITY, VISCOSITY, PLATELET"},
      // auto, horizon, model
      {"auto: \"platelets\"", "auto: \"platelet\"", "effects.auto[0]: 'platelet' is unknown; did you mean 'platelets'?"},
      {"auto: \"platelets\"", "auto: \"xyz\"",
       "effects.auto[0]: 'xyz' is unknown; known are surface_tension, platelets, implicit_viscosity"},
      {"horizon_s: 20", "", "effects.auto[0]: platelets are judged by horizon_s, which is missing"},
      {"horizon_s: 20", "horizon_s: 0", "horizon_s: value 0 is out of range, allowed 0.001 to 1000000 (s)"},
      {"model: SOUND", "model: 3", "model: value 3 is unknown, known are SOUND, LITERAL"},
      {"model: SOUND", "model: SOUND literal {}", "literal: holds numbers of the paper's equations; set model LITERAL"},
      {"model: SOUND", "model: LITERAL literal { contact_radius: 0.6 }",
       "literal.contact_radius: value 0.6 is out of range, allowed 0.05 to 0.5 (spacings)"},
      {"model: SOUND", "model: LITERAL literal { power_1: 4 power_2: 4 }", "literal.power_1: value 4 must be above power_2, 4"},
      // What the literal model lacks, all at once.
      {"model: SOUND", "model: LITERAL", "effects.adhesion: not in model LITERAL, because the paper has no equation"},
      {"model: SOUND", "model: LITERAL", "effects.viscosity.carreau_yasuda: not in model LITERAL, because"},
      {"model: SOUND", "model: LITERAL", "effects.viscosity.solve: no implicit solve in model LITERAL, because"},
      {"model: SOUND", "model: LITERAL", "effects.surface_tension.contact_angle_deg: no contact angle in model LITERAL, because"},
      // What it would not read.
      {"model: SOUND", "model: LITERAL", "resolution.kernel: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.auto: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.pressure.form: is of model SOUND; set literal.pressure"},
      {"model: SOUND", "model: LITERAL", "effects.viscosity.solve_tolerance: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.viscosity.max_iterations: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.surface_tension.temperature_c: is of model SOUND; set literal.tension_n_per_m"},
      {"model: SOUND", "model: LITERAL", "effects.surface_tension.normal_cutoff: is of model SOUND; set literal.normal_cutoff"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.diffusivity_m2_per_s: is of model SOUND; set literal.platelet_diff"},
      {"model: SOUND", "model: LITERAL",
       "effects.platelets.activation_rate_per_s: is of model SOUND; leave it out, because (27)"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.wall_rate_per_s: is of model SOUND; leave it out, because (27)"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.air_rate_per_s: is of model SOUND; leave it out, because (27)"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.shear_gate_per_s: is of model SOUND; leave it out, because (27)"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.clot_speedup: is of model SOUND; leave it out, because (27)"},
      {"model: SOUND", "model: LITERAL", "effects.platelets.clot_viscosity_pa_s: is of model SOUND; set literal.thickening_pa_s"},
      {"model: SOUND", "model: LITERAL", "effects.core_radius.smallest: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.core_radius.largest: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.core_radius.relaxation: is of model SOUND; leave it out, because"},
      {"model: SOUND", "model: LITERAL", "effects.repulsion.strength: is of model SOUND; set literal.repulsion_n_m2"},
      {"model: SOUND", "model: LITERAL", "effects.repulsion.contact_distance: is of model SOUND; set literal.contact_radius"},
      {"model: SOUND", "model: LITERAL", "effects.repulsion.power_1: is of model SOUND; set literal.power_1"},
      {"model: SOUND", "model: LITERAL", "effects.repulsion.power_2: is of model SOUND; set literal.power_2"},
      {"model: SOUND", "model: LITERAL", "effects.repulsion.damping: is of model SOUND; leave it out, because (36)"},
      {"model: SOUND", "fluid_blocks { upper_m { x: 0.01 y: 0.01 z: 0.01 } viscosity_pa_s: 1 } model: LITERAL",
       "fluid_blocks[0].viscosity_pa_s: is not read, because with platelets (26)"},
      // A planar world.
      {"capacity: 5000", "capacity: 5000 planar: true", "tissue: not in a planar world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true", "wounds: not in a planar world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true",
       "effects.surface_tension: surface tension is not in a planar sound world"},
      {"capacity: 5000", "capacity: 5000 planar: true", "effects.platelets: not in a planar sound world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true", "effects.core_radius: not in a planar sound world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true", "effects.adhesion: not in a planar world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true", "effects.viscosity.carreau_yasuda: not in a planar world, because"},
      {"capacity: 5000", "capacity: 5000 planar: true", "effects.viscosity.solve: no implicit solve in a planar world, because"},
  };
  return kRules;
}

TEST(SceneEffects, EachBrokenRuleIsNamedWithItsPath) {
  for (const Rule& rule : rules()) {
    SCOPED_TRACE(rule.from + " -> " + rule.to);
    const Result<SceneDescription> scene = parseScene(replaced(kEffectScene, rule.from, rule.to));
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.status().code(), StatusCode::invalid_argument);
    EXPECT_THAT(scene.status().message(), HasSubstr("\n" + rule.problem));
  }
}

TEST(SceneEffects, WhatAnEffectNeedsIsSaidOfThatEffect) {
  const auto problems_of = [](const std::string& effects) {
    return parseScene(std::string{kLeastScene} + "effects { " + effects + " }").status().message();
  };
  EXPECT_THAT(problems_of("platelets {}"), HasSubstr("effects.platelets: needs viscosity, there is nothing to thicken"));
  EXPECT_THAT(problems_of("viscosity { viscosity_pa_s: 0 } platelets {}"),
              HasSubstr("effects.platelets: needs a viscosity above 0"));
  EXPECT_THAT(problems_of("auto: 'surface_tension'"), HasSubstr("effects.auto[0]: there is no surface_tension"));
  EXPECT_THAT(problems_of("auto: 'platelets'"), HasSubstr("effects.auto[0]: there are no platelets"));
  EXPECT_THAT(problems_of("auto: 'implicit_viscosity'"), HasSubstr("effects.auto[0]: there is no viscosity"));
  EXPECT_THAT(problems_of("viscosity { solve: EXPLICIT } auto: 'implicit_viscosity'"), HasSubstr("is EXPLICIT already"));
  const auto problem_in = [](std::string_view from, std::string_view to) {
    return parseScene(replaced(kLeastScene, from, to) + "effects { viscosity {} auto: 'implicit_viscosity' }").status().message();
  };
  EXPECT_THAT(problem_in("capacity: 10", "capacity: 10 planar: true"), HasSubstr("effects.auto[0]: viscosity is explicit here"));
  EXPECT_THAT(problem_in("0.002", "0.002 kernel: CUBIC_SPLINE"), HasSubstr("effects.auto[0]: viscosity is explicit here"));
  EXPECT_THAT(problems_of("viscosity { viscosity_pa_s: 1 casson {} }"), HasSubstr("rheology"));
  EXPECT_THAT(problems_of("viscosity {} } output { attributes: PLATELET"),
              HasSubstr("output.attributes: PLATELET needs the platelets"));
  EXPECT_THAT(problems_of("surface_tensoin {}"), HasSubstr("did you mean 'surface_tension'?"));
  EXPECT_THAT(problems_of("platelets { clot_viscosity: 1 }"), HasSubstr("did you mean 'clot_viscosity_pa_s'?"));
}

// The literal model's radii go up to 3.75 spacings, whatever the sound model's bounds say.
TEST(SceneEffects, LiteralRadiiNeedRoomOfTheirOwn) {
  const std::string text = replaced(kEffectScene, "model: SOUND", "model: LITERAL");
  EXPECT_THAT(parseScene(replaced(text, "y: -0.05", "y: 0.0276")).status().message(),
              HasSubstr("\neffects.core_radius: three of its reaches are 0.0225 m, the periodic side y is 0.0224 m"));
  EXPECT_THAT(parseScene(replaced(text, "y: -0.05", "y: 0.0274")).status().message(),
              testing::Not(HasSubstr("three of its reaches")));
}

constexpr std::string_view kLiteralScene =
    "model: LITERAL effects { pressure {} viscosity { viscosity_pa_s: 0.02 } "
    "surface_tension {} platelets { fresh: 0.9 } repulsion {} }";

TEST(SceneEffects, TheLiteralModelsTextHasItsOwnNumbersOnly) {
  const Result<SceneDescription> scene = parseScene(std::string{kLeastScene} + std::string{kLiteralScene});
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->world.effects.platelets->fresh, 0.9);
  EXPECT_EQ(scene->world.effects.viscosity->viscosity, 0.02);
  for (const std::string_view foreign : {"sigma_n_per_m", "strength", "wall_rate", "kernel", "form", "solve_tolerance"}) {
    EXPECT_THAT(scene->normalized_text, testing::Not(HasSubstr(std::string{foreign})));
  }
  const Result<SceneDescription> again = parseScene(scene->normalized_text);
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(again->normalized_text, scene->normalized_text);
}

TEST(SceneEffects, AClotOfTheLiteralModelIsThickerThanBlood) {
  const std::string scene = std::string{kLeastScene} + std::string{kLiteralScene};
  EXPECT_TRUE(parseScene(scene + "literal { thickening_pa_s: 0.03 }").ok());
  EXPECT_THAT(parseScene(scene + "literal { thickening_pa_s: 0.01 }").status().message(),
              HasSubstr("literal.thickening_pa_s: value 0.01 is below fresh blood's, 0.02"));
}

TEST(SceneEffects, TheCubicSplineKnowsAdhesion) {
  const Result<SceneDescription> scene =
      parseScene(replaced(kLeastScene, "spacing_m: 0.002", "spacing_m: 0.002 kernel: CUBIC_SPLINE") +
                 "effects { pressure {} adhesion {} } tissue { plane { normal { z: 1 } } }");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_TRUE(sph::createWorld(scene->world, {}).ok());
}

TEST(SceneEffects, TensionOnTooFewNeighboursIsWarnedOf) {
  const std::string tension = std::string{kLeastScene} + "effects { surface_tension {} }";
  const Result<SceneDescription> few = parseScene(tension);
  ASSERT_TRUE(few.ok()) << few.status().message();
  EXPECT_THAT(few->warnings, ElementsAre("warning: surface_tension: drops boil at support_ratio 2; use 2.5 or more"));
  const Result<SceneDescription> enough =
      parseScene(replaced(tension, "spacing_m: 0.002", "spacing_m: 0.002 support_ratio: 2.5"));
  ASSERT_TRUE(enough.ok());
  EXPECT_THAT(enough->warnings, testing::IsEmpty());
  const Result<SceneDescription> without = parseScene(kLeastScene);
  EXPECT_THAT(without->warnings, testing::IsEmpty());
}

TEST(SceneEffects, AllProblemsAreToldAtOnce) {
  std::string text = replaced(kEffectScene, "power_1: 7", "power_1: 2");
  text = replaced(text, "fresh: 0.98", "fresh: 2");
  text = replaced(text, "tissue { plane { normal { z: 1 } } }", "");
  EXPECT_THAT(parseScene(text).status().message(), HasSubstr("the scene has 4 problems:"));
}

}  // namespace
}  // namespace bleedsim::scene
