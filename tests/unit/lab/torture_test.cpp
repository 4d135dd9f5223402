// A plan that fails is made small; what a failure needs stays.
#include "service/lab/torture/torture.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "service/scene/scene.h"

namespace bleedsim::lab {
namespace {

using scene::Scene;

/// The first plan from a seed on that `suits`.
template <class Suits>
TorturePlan planThat(const Suits& suits) {
  for (std::uint64_t seed = 1;; ++seed) {
    TorturePlan plan = makePlan(seed, Scene::SOUND, 100);
    if (suits(plan)) return plan;
  }
}

bool isRich(const TorturePlan& plan) {
  return plan.commands.size() >= 3 && plan.scene.fluid_blocks_size() >= 2 && plan.scene.tissue_size() >= 1 &&
         plan.scene.effects().has_surface_tension() && plan.scene.effects().has_gravity() && particlesOf(plan) > 60;
}

// An injected failure: tension with a block that still holds a particle and at least five steps.
TEST(Shrink, leavesOnlyWhatTheFailureNeeds) {
  const TorturePlan rich = planThat(isRich);
  int runs = 0;
  const TorturePlan small = shrink(rich, [&](const TorturePlan& plan) {
    ++runs;
    return plan.scene.effects().has_surface_tension() && particlesOf(plan) >= 1 && plan.steps >= 5;
  });
  EXPECT_LE(runs, 300);
  EXPECT_TRUE(small.scene.effects().has_surface_tension());
  EXPECT_FALSE(small.scene.effects().has_gravity());
  EXPECT_FALSE(small.scene.effects().has_pressure());
  EXPECT_FALSE(small.scene.effects().has_viscosity());
  EXPECT_TRUE(small.commands.empty());
  EXPECT_TRUE(small.changes.empty());
  EXPECT_TRUE(small.limits.empty());
  EXPECT_EQ(small.scene.wounds_size(), 0);
  EXPECT_EQ(small.scene.tissue_size(), 0);
  ASSERT_EQ(small.scene.fluid_blocks_size(), 1);
  EXPECT_EQ(particlesOf(small), 1u);
  EXPECT_EQ(small.scene.fluid_blocks(0).jitter(), 0.0);
  EXPECT_GE(small.steps, 5);
  EXPECT_LT(small.steps, 10);
}

TEST(Shrink, keepsTheOneCommandThatMatters) {
  const TorturePlan rich = planThat([](const TorturePlan& plan) {
    return plan.commands.size() >= 4 && std::holds_alternative<sph::SetForce>(plan.commands[1].command);
  });
  const auto& wanted = std::get<sph::SetForce>(rich.commands[1].command);
  const auto fails = [&](const TorturePlan& plan) {
    for (const TimedCommand& timed : plan.commands) {
      const auto* force = std::get_if<sph::SetForce>(&timed.command);
      if (force != nullptr && force->position == wanted.position) return true;
    }
    return false;
  };
  const TorturePlan small = shrink(rich, fails);
  ASSERT_EQ(small.commands.size(), 1u);
  EXPECT_TRUE(fails(small));
}

TEST(Shrink, keepsTheOneSwitchThatMattersWithoutItsSettings) {
  const TorturePlan rich = planThat([](const TorturePlan& plan) {
    return plan.changes.size() >= 3 && plan.changes[1].change.enabled && !plan.changes[1].change.settings.empty();
  });
  const TimedChange wanted = rich.changes[1];
  const auto fails = [&](const TorturePlan& plan) {
    const auto same = [&](const TimedChange& timed) {
      return timed.step == wanted.step && timed.change.name == wanted.change.name && timed.change.enabled;
    };
    return std::any_of(plan.changes.begin(), plan.changes.end(), same);
  };
  const TorturePlan small = shrink(rich, fails);
  ASSERT_EQ(small.changes.size(), 1u);
  EXPECT_TRUE(fails(small));
  EXPECT_EQ(small.changes.front().change.settings, "");
}

TEST(Shrink, stopsWhenItsTriesAreSpent) {
  const TorturePlan rich = planThat(isRich);
  int runs = 0;
  const TorturePlan same = shrink(
      rich,
      [&](const TorturePlan&) {
        ++runs;
        return false;
      },
      5);
  EXPECT_EQ(runs, 5);
  EXPECT_EQ(toText(same), toText(rich));
}

/// A command that puts a new wound more than a spacing deep into the plane of a plan.
bool buries(const TorturePlan& plan) {
  for (const TimedCommand& timed : plan.commands) {
    const auto* add = std::get_if<sph::AddWound>(&timed.command);
    if (add == nullptr) continue;
    const scene::Vec3& n = plan.scene.tissue(0).plane().normal();
    if (add->wound.position.dot(sph::Vec3{n.x(), n.y(), n.z()}) < -plan.scene.resolution().spacing_m()) return true;
  }
  return false;
}

TEST(Torture, placesWoundsInsideTissueAndSeesThemRefused) {
  const TorturePlan plan = planThat([](const TorturePlan& some) { return buries(some) && !runPlan(some).refused; });
  const TortureOutcome outcome = runPlan(plan);
  EXPECT_TRUE(outcome.holds) << outcome.text;
  const auto scene = scene::parseScene(toText(plan));
  ASSERT_TRUE(scene.ok());
  const auto world = sph::createWorld(scene->world, {});
  ASSERT_TRUE(world.ok());
  int refused = 0;
  for (const TimedCommand& timed : plan.commands) {
    const bool adds = std::holds_alternative<sph::AddWound>(timed.command);
    if (adds && (*world)->apply(timed.command).status().message().find("inside tissue") != std::string::npos) ++refused;
  }
  EXPECT_GE(refused, 1);
}

TEST(TorturePlan, SwitchesEveryEffectThatThereIs) {
  std::set<std::string> switched;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    for (const TimedChange& timed : makePlan(seed, Scene::SOUND, 100).changes) switched.insert(timed.change.name);
  }
  const std::vector<std::string> known = scene::knownEffects();
  EXPECT_EQ(switched, std::set<std::string>(known.begin(), known.end()));
}

// What cannot be switched is refused; everything else takes place.
TEST(Torture, switchesEffectsAsASessionDoes) {
  TorturePlan plan = planThat([](const TorturePlan& some) {
    const scene::Effects& effects = some.scene.effects();
    const bool bare = !effects.has_viscosity() && !effects.has_repulsion() && some.scene.tissue_size() == 0;
    return bare && some.changes.empty() && !runPlan(some).refused;
  });
  plan.changes = {{10, {"repulsion", true, {}}},
                  {20, {"adhesion", true, {}}},
                  {20, {"repulsion", false, {}}},
                  {30, {"viscosity", true, "viscosity_pa_s: 0.02"}},
                  {40, {"viscosity", true, "viscosity_pa_s: -1"}}};
  const TortureOutcome outcome = runPlan(plan);
  EXPECT_TRUE(outcome.holds) << outcome.text;
  EXPECT_EQ(outcome.switched, 3u);
  EXPECT_EQ(outcome.not_switched, 2u) << "no tissue to stick to, no viscosity below zero";
}

// What is written is a scene of its own, which bleedd and bleedlab read; commands and switches stand in front of it.
TEST(PlanText, isASceneWithItsCommands) {
  const TorturePlan rich = planThat([](const TorturePlan& plan) {
    const bool switches = std::any_of(plan.changes.begin(), plan.changes.end(),
                                      [](const TimedChange& timed) { return timed.change.settings.size() > 40; });
    return isRich(plan) && switches && !runPlan(plan).refused;
  });
  const std::string text = toText(rich);
  const auto parsed = scene::parseScene(text);
  ASSERT_TRUE(parsed.ok()) << parsed.status().message();
  EXPECT_EQ(parsed->world.fluid_blocks.size(), static_cast<std::size_t>(rich.scene.fluid_blocks_size()));
  std::size_t lines = 0;
  for (std::size_t at = text.find("# before step"); at != std::string::npos; at = text.find("# before step", at + 1)) ++lines;
  EXPECT_EQ(lines, rich.commands.size() + rich.changes.size() + rich.limits.size());
}

}  // namespace
}  // namespace bleedsim::lab
