// What a world refuses to hold together, and why it says so.
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Refusal {
  const char* named;  // must stand in the message
  std::function<void(EffectSettings&)> change;
};

void expectRefusal(WorldDescription description, const Refusal& refusal, StatusCode code) {
  refusal.change(description.effects);
  for (const Precision precision : {Precision::float32, Precision::float64}) {
    const auto world = createWorld(description, {.precision = precision});
    ASSERT_FALSE(world.ok()) << refusal.named;
    EXPECT_EQ(world.status().code(), code) << world.status().message();
    EXPECT_NE(world.status().message().find(refusal.named), std::string::npos) << world.status().message();
    EXPECT_NE(world.status().message().find("use "), std::string::npos) << "no remedy: " << world.status().message();
  }
}

TEST(WorldChecks, TheCubicSplineKnowsPressureAndExplicitNewtonianViscosityOnly) {
  WorldDescription description = test::freeBlock({5, 5, 5}, 0.2);
  description.kernel = KernelType::cubic_spline;
  for (const Refusal& refusal : std::vector<Refusal>{
           {"surface_tension", [](EffectSettings& e) { e.surface_tension.emplace(); }},
           {"platelets", [](EffectSettings& e) { e.platelets.emplace(); }},
           {"core_radius", [](EffectSettings& e) { e.core_radius.emplace(); }},
           {"repulsion", [](EffectSettings& e) { e.repulsion.emplace(); }},
           {"implicit", [](EffectSettings& e) { e.viscosity->solve = ViscositySolve::implicit; }},
           {"shear rate", [](EffectSettings& e) { e.viscosity->rheology = CarreauYasudaRheology{}; }},
           {"shear rate", [](EffectSettings& e) { e.viscosity->rheology = CassonRheology{}; }},
       }) {
    expectRefusal(description, refusal, StatusCode::unsupported);
  }
  description.effects.gravity.emplace();
  description.effects.applied_force.emplace();
  description.effects.viscosity->viscosity = 50.0;  // explicit here, however small the step
  for (const PressureForm form : {PressureForm::variational, PressureForm::symmetric}) {
    description.effects.pressure->form = form;
    const auto world = test::makeWorld(description);
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(world->step(1.0).ok());
    EXPECT_EQ(test::statsOf(*world).viscosity_iterations, 0);
  }
}

TEST(WorldChecks, SettingsOfCoreRadiusAreBounded) {
  for (const double bad : {0.49, 1.01, kNan, -1.0}) {
    expectRefusal(test::freeBlock({2, 2, 2}),
                  {"core_radius.smallest", [bad](EffectSettings& e) { e.core_radius = CoreRadiusSettings{.smallest = bad}; }},
                  StatusCode::invalid_argument);
  }
  for (const double bad : {0.99, 1.51, kNan}) {
    expectRefusal(test::freeBlock({2, 2, 2}),
                  {"core_radius.largest", [bad](EffectSettings& e) { e.core_radius = CoreRadiusSettings{.largest = bad}; }},
                  StatusCode::invalid_argument);
  }
  for (const double bad : {0.0, -0.1, 1.1, kNan}) {
    expectRefusal(test::freeBlock({2, 2, 2}),
                  {"core_radius.relaxation", [bad](EffectSettings& e) { e.core_radius = CoreRadiusSettings{.relaxation = bad}; }},
                  StatusCode::invalid_argument);
  }
  WorldDescription extreme = test::freeBlock({3, 3, 3});
  extreme.effects.core_radius = CoreRadiusSettings{.smallest = 0.5, .largest = 1.5, .relaxation = 1.0};
  EXPECT_TRUE(createWorld(extreme, {}).ok());
}

TEST(WorldChecks, SettingsOfRepulsionAreBounded) {
  const auto refused = [](const char* named, const RepulsionSettings& settings) {
    expectRefusal(test::freeBlock({2, 2, 2}), {named, [&](EffectSettings& e) { e.repulsion = settings; }},
                  StatusCode::invalid_argument);
  };
  for (const double bad : {-0.1, 101.0, kNan}) refused("repulsion.strength", {.strength = bad});
  for (const double bad : {0.0, 0.09, 1.01, kNan}) refused("repulsion.contact_distance", {.contact_distance = bad});
  for (const double bad : {-0.1, 10.1, kNan}) refused("repulsion.damping", {.damping = bad});
  refused("repulsion.power", {.power_1 = 4, .power_2 = 4});
  refused("repulsion.power", {.power_1 = 3, .power_2 = 4});
  refused("repulsion.power", {.power_1 = 6, .power_2 = 0});
  refused("repulsion.power", {.power_1 = 17, .power_2 = 4});
  WorldDescription extreme = test::freeBlock({3, 3, 3});
  extreme.effects.repulsion =
      RepulsionSettings{.strength = 100.0, .contact_distance = 1.0, .power_1 = 16, .power_2 = 1, .damping = 10.0};
  EXPECT_TRUE(createWorld(extreme, {}).ok());
}

// The grid needs three cells along a periodic side, and cells follow the largest radius that a particle may have.
TEST(WorldChecks, PeriodicSidesHoldThreeOfTheLargestRadii) {
  const auto box = [](int cells) {
    WorldDescription description = test::periodicBox({8, 8, cells});
    description.effects.core_radius.emplace();
    return description;
  };
  EXPECT_TRUE(createWorld(test::periodicBox({8, 8, 6}), {}).ok());
  EXPECT_TRUE(createWorld(box(8), {}).ok());
  const auto narrow = createWorld(box(7), {});
  ASSERT_FALSE(narrow.ok());
  EXPECT_NE(narrow.status().message().find("0.0078"), std::string::npos) << narrow.status().message();
}

}  // namespace
}  // namespace bleedsim::sph
