// Effects switched on and off while a pool moves: World::adopt gives no impulse.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "service/sph/effects/effect_list.h"
#include "service/sph/effects/literal_list.h"
#include "tests/stability/sph/measure.h"
#include "tests/unit/sph/frame_differences.h"
#include "tests/unit/sph/stirred_pool.h"

namespace bleedsim::sph {
namespace {

struct Toggle {
  Model model;
  const EffectRow* effect;
  bool on;
};

/// Every switch of every effect of either model that `wanted` names.
template <class Wanted>
std::vector<Toggle> toggles(const Wanted& wanted) {
  std::vector<Toggle> all;
  for (const Model model : {Model::sound, Model::literal}) {
    for (const EffectRow& effect : kEffects) {
      if (model == Model::literal && literalText(effect.info.name).empty()) continue;
      for (const bool on : {true, false}) {
        if (wanted(Toggle{model, &effect, on})) all.push_back({model, &effect, on});
      }
    }
  }
  return all;
}

/// A pool that moves at 0.1 m/s, without a wound.
WorldDescription pool(Model model) {
  WorldDescription scene = poolOf(0.006, 0.006, 0.03);
  scene.model = model;
  scene.wounds.clear();
  scene.capacity = 2000;
  scene.fluid_blocks.front().velocity = {0.1, 0.0, 0.0};
  return scene;
}

/// Kinetic energy of the difference of two worlds' velocities, as a part of the twin's kinetic energy.
double differenceOf(const World& world, const World& twin) {
  const FrameBuffer a = test::frameOf(world);
  const FrameBuffer b = test::frameOf(twin);
  const std::vector<std::size_t> of_a = orderById(a);
  const std::vector<std::size_t> of_b = orderById(b);
  EXPECT_EQ(a.count, b.count);
  double apart = 0.0;
  double whole = 0.0;
  for (std::size_t k = 0; k < std::min(of_a.size(), of_b.size()); ++k) {
    EXPECT_EQ(a.id[of_a[k]], b.id[of_b[k]]);
    apart += (test::velocityOf(a, of_a[k]) - test::velocityOf(b, of_b[k])).squaredNorm();
    whole += test::velocityOf(b, of_b[k]).squaredNorm();
  }
  return apart / whole;
}

/// Toggles that do give an impulse: pressure of either model that goes on, and three of the literal model's terms.
bool comesWithAJolt(const Toggle& toggle) {
  const std::string_view name = toggle.effect->info.name;
  if (toggle.model == Model::sound) return name == "pressure" && toggle.on;
  return name == "pressure" || name == "core_radius" || name == "repulsion";
}

class EffectToggle : public testing::TestWithParam<Toggle> {
 protected:
  void SetUp() override {
    const Toggle& toggle = GetParam();
    WorldDescription before = pool(toggle.model);
    WorldDescription after = before;
    if (toggle.on) {
      toggle.effect->slot.remove(before.effects);
      toggle.effect->slot.add(after.effects, {});
    } else {
      toggle.effect->slot.add(before.effects, {});
      toggle.effect->slot.remove(after.effects);
    }
    const WorldOptions options{.speed_of_sound = speedOfSound(pool(toggle.model))};
    twin_ = test::makeWorld(before, options);
    const auto old = test::makeWorld(before, options);
    for (World* world : {twin_.get(), old.get()}) {
      if (toggle.effect->info.name == "applied_force" && !toggle.on) stir(*world);
      const double step = 0.1 * before.spacing / world->speedOfSound();
      for (int k = 0; k < 160; ++k) ASSERT_TRUE(world->step(step).ok());
    }
    then_ = test::statsOf(*old);
    heir_ = test::makeWorld(after, options);
    ASSERT_TRUE(heir_->adopt(*old).ok());
    step_ = 0.1 * before.spacing / twin_->speedOfSound();
  }

  void stepBoth(double dt) {
    for (World* world : {heir_.get(), twin_.get()}) ASSERT_TRUE(world->step(dt).ok());
    ASSERT_NEAR(heir_->time(), twin_->time(), 1e-6 * step_) << "a step that is not common";
  }
  double growth() const { return test::statsOf(*heir_).kinetic_energy / test::statsOf(*twin_).kinetic_energy - 1.0; }

  std::unique_ptr<World> heir_, twin_;
  WorldStats then_;
  double step_ = 0.0;  // s: that which repulsion needs, physics.md section 2
};

TEST_P(EffectToggle, TakesTheStateOver) {
  const WorldStats now = test::statsOf(*heir_);
  EXPECT_EQ(now.kinetic_energy, then_.kinetic_energy);
  EXPECT_EQ(now.momentum, then_.momentum);
  EXPECT_EQ(now.particles, then_.particles);
}

class GentleToggle : public EffectToggle {};

// An impulse is a change of momentum that a force needs no time for; J^2/(2 m), the kinetic energy of the difference to the twin
// that was not switched, is its energy. The window is 5 dx/c0, in which sound crosses more than two support radii: what a switch
// releases at once has become velocity by then, and a true force F has done no more than (F t)^2/(2 m). The largest figures of
// the sound model: surface tension 1.4 %, repulsion off 2.5 %. The kinetic energy itself, in which a force works with F v t from
// the start, is compared over 1 dx/c0 (a stirring force that ends: 1.7 %).
TEST_P(GentleToggle, GivesNoImpulse) {
  for (int k = 0; k < 50; ++k) {
    stepBoth(step_);
    if (k % 5 == 4 || k == 0) { ASSERT_LE(differenceOf(*heir_, *twin_), 0.05) << "step " << k; }
    if (k < 10) { ASSERT_LE(std::abs(growth()), 0.05) << "step " << k; }
  }
}

// Without pressure nothing keeps blood from being pressed together, and with it that overlap becomes speed (physics.md section
// 4): 2.5 times the kinetic energy here, after 16 dx/c0 without. The switch gives nothing of it: kinetic and elastic energy, that
// of the contact springs and of gravity together stay where they were, here to 1.3 % of the kinetic one.
TEST(EffectToggles, PressureThatGoesOnReleasesNoMoreThanWasPressedIn) {
  WorldDescription scene = pool(Model::sound);
  scene.effects.pressure.reset();
  const auto old = test::makeWorld(scene);
  const double step = 0.1 * scene.spacing / old->speedOfSound();
  for (int k = 0; k < 160; ++k) ASSERT_TRUE(old->step(step).ok());
  const double kinetic = test::statsOf(*old).kinetic_energy;
  scene.effects.pressure.emplace();
  const auto heir = test::makeWorld(scene, {.speed_of_sound = old->speedOfSound()});
  ASSERT_TRUE(heir->adopt(*old).ok());
  const double before = test::energyOf(*heir);
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(heir->step(step).ok());
    ASSERT_LE(test::energyOf(*heir) - before, 0.05 * kinetic) << "step " << k;
  }
}

class LiteralJolt : public EffectToggle {};

// The paper has nothing that lets these three come softly, and the literal model is as printed: pressure pulls below rest density
// (+27 times the kinetic energy on, 0.19 of it lost off), radii jump by (34) at once (+0.48, -0.31), particles that stand in
// contact burst apart (+44, +0.47).
TEST_P(LiteralJolt, IsWhatThreeSwitchesBring) {
  double most = 0.0;
  for (int k = 0; k < 50; ++k) {
    stepBoth(step_);
    most = std::max(most, std::abs(growth()));
  }
  RecordProperty("kinetic_energy_growth", std::to_string(most));
  EXPECT_GT(most, 0.05) << "it does not any more: take it off the list";
}

/// Effects that do no work of their own on the whole: for 200 dx/c0, in which also the contacts of repulsion have grown to their
/// full size.
class ToggleForLong : public EffectToggle {};

// Measured: 0.4 % at most, core radius off 1.0 %. Repulsion on, 6.1 %: the pool's particles stand in each other's way and spread
// otherwise; 10 % is allowed.
TEST_P(ToggleForLong, BringsNoEnergy) {
  const double bound = GetParam().effect->info.name == "repulsion" ? 0.10 : 0.05;
  for (int k = 0; k < 650; ++k) {
    for (int part = 0; part < 3; ++part) ASSERT_TRUE(heir_->step(step_).ok());
    while (twin_->time() < heir_->time() - 1e-3 * step_) ASSERT_TRUE(twin_->step(heir_->time() - twin_->time()).ok());
    if (k % 10 == 9) { ASSERT_LE(growth(), bound) << "step " << k; }
  }
}

std::string nameOf(const testing::TestParamInfo<Toggle>& tested) {
  return std::string{tested.param.model == Model::literal ? "literal_" : "sound_"} + std::string{tested.param.effect->info.name} +
         (tested.param.on ? "_on" : "_off");
}

bool bringsNoWork(const Toggle& toggle) {
  const std::string_view name = toggle.effect->info.name;
  const bool on_only = name == "viscosity" || name == "repulsion";
  return toggle.model == Model::sound && (name == "platelets" || name == "core_radius" || (on_only && toggle.on));
}

bool isAny(const Toggle&) { return true; }
bool isGentle(const Toggle& toggle) { return !comesWithAJolt(toggle); }
bool isLiteralJolt(const Toggle& toggle) { return toggle.model == Model::literal && comesWithAJolt(toggle); }

INSTANTIATE_TEST_SUITE_P(Every, EffectToggle, testing::ValuesIn(toggles(isAny)), nameOf);
INSTANTIATE_TEST_SUITE_P(Every, GentleToggle, testing::ValuesIn(toggles(isGentle)), nameOf);
INSTANTIATE_TEST_SUITE_P(Every, LiteralJolt, testing::ValuesIn(toggles(isLiteralJolt)), nameOf);
INSTANTIATE_TEST_SUITE_P(Some, ToggleForLong, testing::ValuesIn(toggles(bringsNoWork)), nameOf);

struct Change {
  const char* name;
  std::function<void(EffectSettings&)> make;
};

class VariantToggle : public testing::TestWithParam<Change> {};

// Another form of an effect, by the same criterion as its switch.
TEST_P(VariantToggle, GivesNoImpulse) {
  const WorldDescription before = pool(Model::sound);
  WorldDescription after = before;
  GetParam().make(after.effects);
  const auto twin = test::makeWorld(before);
  const auto old = test::makeWorld(before);
  const double step = 0.1 * before.spacing / twin->speedOfSound();
  for (World* world : {twin.get(), old.get()}) {
    for (int k = 0; k < 160; ++k) ASSERT_TRUE(world->step(step).ok());
  }
  const auto heir = test::makeWorld(after);
  ASSERT_TRUE(heir->adopt(*old).ok());
  for (int k = 0; k < 50; ++k) {
    for (World* world : {heir.get(), twin.get()}) ASSERT_TRUE(world->step(step).ok());
    ASSERT_LE(differenceOf(*heir, *twin), 0.05) << "step " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, VariantToggle,
    testing::Values(Change{"thick", [](EffectSettings& e) { e.viscosity->viscosity = 0.2; }},
                    Change{"casson", [](EffectSettings& e) { e.viscosity->rheology = CassonRheology{}; }},
                    Change{"implicit", [](EffectSettings& e) { e.viscosity->solve = ViscositySolve::implicit; }},
                    Change{"symmetric", [](EffectSettings& e) { e.pressure->form = PressureForm::symmetric; }}),
    [](const auto& tested) { return std::string{tested.param.name}; });

}  // namespace
}  // namespace bleedsim::sph
