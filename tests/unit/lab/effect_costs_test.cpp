// What effects cost: that every shipped scene can be measured and what is compared with what. Times are not judged.
#include "service/lab/effect_costs.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/scene/scene.h"

namespace bleedsim::lab {
namespace {

constexpr CostOptions kShort{.particles = 1000, .threads = 1, .simd = sph::SimdTarget::automatic, .seconds = 0.01, .steps = 1};

EffectCosts costsOf(const sph::WorldDescription& scene) {
  auto costs = measureEffectCosts(scene, kShort, [](double) {});
  EXPECT_TRUE(costs.ok()) << costs.status().message();
  return costs.ok() ? *costs : EffectCosts{};
}

const EffectCost& find(const EffectCosts& costs, const std::string& name) {
  for (const EffectCost& cost : costs.effects) {
    if (cost.name == name) return cost;
  }
  ADD_FAILURE() << "no " << name;
  return costs.effects.front();
}

TEST(EffectCosts, OfEveryShippedSceneAreMeasured) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator{SCENE_DIR}) {
    if (entry.path().extension() != ".textproto") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const auto scene = scene::loadScene(entry.path());
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    ++scenes;
    const EffectCosts costs = costsOf(scene->world);
    EXPECT_GE(costs.turns, kLeastTurns);
    EXPECT_GE(costs.particles, 900u);
    EXPECT_GT(costs.scene.microseconds.value, 0.0);
    for (const EffectCost& cost : costs.effects) {
      EXPECT_TRUE(cost.alone || !cost.refusal.empty()) << cost.name;
      EXPECT_EQ(cost.in_scene, cost.without.has_value()) << cost.name << ": " << cost.refusal;
    }
  }
  EXPECT_GE(scenes, 18);
}

TEST(EffectCosts, CompareWithTheSmallestSetThatIsLegal) {
  sph::WorldDescription scene;
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.platelets.emplace();
  const EffectCosts costs = costsOf(scene);
  for (const char* name : {"gravity", "pressure", "viscosity", "surface_tension"}) {
    const EffectCost& cost = find(costs, name);
    ASSERT_TRUE(cost.alone.has_value()) << name;
    EXPECT_THAT(cost.alone->others, testing::IsEmpty()) << name << " is compared with no effect at all";
  }
  EXPECT_DOUBLE_EQ(find(costs, "viscosity").alone->bytes, find(costs, "viscosity").alone->cost.bytes - costs.nothing.bytes);
  const EffectCost& platelets = find(costs, "platelets");
  ASSERT_TRUE(platelets.alone && platelets.without);
  EXPECT_THAT(platelets.alone->others, testing::ElementsAre("viscosity"));
  EXPECT_DOUBLE_EQ(platelets.alone->bytes, platelets.alone->cost.bytes - find(costs, "viscosity").alone->cost.bytes);
  EXPECT_THAT(platelets.without->others, testing::IsEmpty());
  const EffectCost& viscosity = find(costs, "viscosity");
  ASSERT_TRUE(viscosity.without.has_value());
  EXPECT_THAT(viscosity.without->others, testing::ElementsAre("platelets")) << "they cannot stay without it";
}

TEST(CostDifference, IsNoiseWithinTwiceItsScatter) {
  CostDifference difference;
  difference.microseconds = {0.2, 0.11};
  EXPECT_FALSE(difference.counts());
  difference.microseconds = {0.2, 0.09};
  EXPECT_TRUE(difference.counts());
  difference.microseconds = {-0.2, 0.09};
  EXPECT_TRUE(difference.counts());
}

}  // namespace
}  // namespace bleedsim::lab
