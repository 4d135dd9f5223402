// World::adopt: a world goes on where another one was.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

/// A pool on tissue that a wound feeds and a tool stirs.
WorldDescription pool() {
  WorldDescription scene = test::woundOnPlane(0.003, 3e-6);
  FluidBlock block;
  block.lower = {-0.012, -0.012, 0.0};
  block.upper = {0.012, 0.012, 0.008};
  block.jitter = 0.1;
  scene.fluid_blocks.push_back(block);
  scene.effects.applied_force.emplace();
  return scene;
}

void stir(World& world) {
  SetForce force;
  force.key = 1;
  force.position = {0.0, 0.0, 0.006};
  force.radius = 0.004;
  force.force = {0.002, 0.0, 0.0};
  force.until = 0.05;
  ASSERT_TRUE(world.apply(force).ok());
}

void step(World& world, int count) {
  for (int i = 0; i < count; ++i) ASSERT_TRUE(world.step(1.0).ok());
}

void expectSameState(const World& a, const World& b) {
  EXPECT_EQ(a.stateHash(), b.stateHash());
  const WorldStats x = test::statsOf(a);
  const WorldStats y = test::statsOf(b);
  EXPECT_EQ(x.step, y.step);
  EXPECT_EQ(x.time, y.time);
  EXPECT_EQ(x.dt, y.dt);
  EXPECT_EQ(x.particles, y.particles);
  EXPECT_EQ(x.injected, y.injected);
  EXPECT_EQ(x.removed, y.removed);
  EXPECT_EQ(x.emitted_volume, y.emitted_volume);
  EXPECT_EQ(x.commanded_volume, y.commanded_volume);
  EXPECT_EQ(x.mean_density_error, y.mean_density_error);
  EXPECT_EQ(x.max_density_error, y.max_density_error);
  EXPECT_EQ(x.max_speed, y.max_speed);
  EXPECT_EQ(x.kinetic_energy, y.kinetic_energy);
  EXPECT_EQ(x.momentum, y.momentum);
  EXPECT_EQ(x.counters, y.counters);
  ASSERT_EQ(a.wounds().size(), b.wounds().size());
  for (std::size_t i = 0; i < a.wounds().size(); ++i) EXPECT_EQ(a.wounds()[i].emitted, b.wounds()[i].emitted);
}

class Adopt : public testing::TestWithParam<WorldOptions> {};

TEST_P(Adopt, AWorldThatTakesOverStepsOnLikeItsTwin) {
  const auto twin = test::makeWorld(pool(), GetParam());
  const auto old = test::makeWorld(pool(), GetParam());
  for (World* world : {twin.get(), old.get()}) {
    stir(*world);
    step(*world, 30);
    UpdateWound faster;
    faster.wound_id = 1;
    faster.drive = FlowDrive{5e-6};
    ASSERT_TRUE(world->apply(faster).ok());
    step(*world, 10);
  }
  const auto heir = test::makeWorld(pool(), GetParam());
  ASSERT_TRUE(heir->adopt(*old).ok());
  expectSameState(*heir, *twin);
  step(*heir, 60);
  step(*twin, 60);
  expectSameState(*heir, *twin);
  RemoveWound gone;
  gone.wound_id = 1;
  ASSERT_TRUE(heir->apply(gone).ok());
  ASSERT_TRUE(twin->apply(gone).ok());
  step(*heir, 5);
  step(*twin, 5);
  expectSameState(*heir, *twin);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Adopt,
                         testing::Values(WorldOptions{.threads = 1}, WorldOptions{.threads = 2},
                                         WorldOptions{.precision = Precision::float64}));

struct Toggle {
  const char* name;
  std::function<void(EffectSettings&)> change;
  double longest_step = 1.0;  ///< dx/c0
  int steps = 300;
};

class AdoptToggle : public testing::TestWithParam<Toggle> {};

// The state is taken over as it is: energy and momentum are equal to the bit. In the next step an effect may change the
// velocities by a dt, which is no impulse: at most 5 % of the kinetic energy of a pool that moves at 0.1 m/s. None of the steps
// after it adds as much, those in which the contacts of repulsion grow included (200 dx/c0).
TEST_P(AdoptToggle, CostsNoImpulse) {
  WorldDescription before = pool();
  before.fluid_blocks[0].velocity = {0.1, 0.0, 0.0};
  const auto old = test::makeWorld(before, {});
  step(*old, 40);
  const WorldStats then = test::statsOf(*old);
  WorldDescription after = before;
  GetParam().change(after.effects);
  after.max_dt = GetParam().longest_step * after.spacing / old->speedOfSound();
  const auto heir = test::makeWorld(after, {.speed_of_sound = old->speedOfSound()});
  ASSERT_TRUE(heir->adopt(*old).ok());
  const WorldStats now = test::statsOf(*heir);
  EXPECT_EQ(now.kinetic_energy, then.kinetic_energy);
  EXPECT_EQ(now.momentum, then.momentum);
  EXPECT_EQ(now.particles, then.particles);
  step(*heir, 1);
  double last = test::statsOf(*heir).kinetic_energy;
  EXPECT_LE(std::abs(last - then.kinetic_energy), 0.05 * then.kinetic_energy);
  for (int i = 0; i < GetParam().steps; ++i) {
    step(*heir, 1);
    const double next = test::statsOf(*heir).kinetic_energy;
    ASSERT_LE(next, 1.05 * last) << "step " << i;
    last = next;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, AdoptToggle,
                         testing::Values(Toggle{"viscosity_off", [](EffectSettings& e) { e.viscosity.reset(); }},
                                         Toggle{"thick", [](EffectSettings& e) { e.viscosity->viscosity = 0.5; }},
                                         Toggle{"casson", [](EffectSettings& e) { e.viscosity->rheology = CassonRheology{}; }},
                                         Toggle{"symmetric",
                                                [](EffectSettings& e) { e.pressure->form = PressureForm::symmetric; }},
                                         Toggle{"gravity_off", [](EffectSettings& e) { e.gravity.reset(); }},
                                         // 0.1 dx/c0: the step that repulsion needs, physics.md section 2.
                                         Toggle{"repulsion", [](EffectSettings& e) { e.repulsion.emplace(); }, 0.1, 2200},
                                         Toggle{"tension", [](EffectSettings& e) { e.surface_tension.emplace(); }},
                                         Toggle{"platelets", [](EffectSettings& e) { e.platelets.emplace(); }},
                                         Toggle{"adhesion", [](EffectSettings& e) { e.adhesion.emplace(); }},
                                         Toggle{"core_radius", [](EffectSettings& e) { e.core_radius.emplace(); }},
                                         Toggle{"force_off", [](EffectSettings& e) { e.applied_force.reset(); }}),
                         [](const auto& tested) { return std::string{tested.param.name}; });

TEST(AdoptState, TheNextStepObeysTheNewLimits) {
  const auto old = test::makeWorld(pool(), {});
  step(*old, 20);
  WorldDescription thick = pool();
  thick.effects.viscosity->viscosity = 50.0;
  thick.effects.viscosity->solve = ViscositySolve::explicit_;
  const auto heir = test::makeWorld(thick, {});
  ASSERT_TRUE(heir->adopt(*old).ok());
  step(*heir, 1);
  // 0.045 h^2 rho/mu, physics.md section 2.
  const double h = thick.supportRadius();
  EXPECT_LE(test::statsOf(*heir).dt, 0.045 * h * h * thick.rest_density / 50.0 * (1.0 + 1e-12));
}

TEST(AdoptState, AnImplicitSolveEndsWhereTheNewWorldHasNone) {
  WorldDescription description = pool();
  description.effects.viscosity->solve = ViscositySolve::implicit;
  description.effects.viscosity->viscosity = 5.0;
  for (const bool viscous : {true, false}) {
    SCOPED_TRACE(viscous);
    const auto old = test::makeWorld(description, {});
    stir(*old);
    step(*old, 5);
    ASSERT_GT(test::statsOf(*old).viscosity_iterations, 0);
    WorldDescription other = description;
    other.effects.viscosity->solve = ViscositySolve::explicit_;
    if (!viscous) other.effects.viscosity.reset();
    const auto heir = test::makeWorld(other, {});
    ASSERT_TRUE(heir->adopt(*old).ok());
    step(*heir, 5);
    EXPECT_EQ(test::statsOf(*heir).viscosity_iterations, 0);
    EXPECT_FALSE(heir->faulted());
  }
}

TEST(AdoptState, BloodFollowsItsDefaultAndAFluidBlockKeepsItsOwn) {
  WorldDescription description = pool();
  FluidBlock thick;
  thick.lower = {-0.012, -0.012, 0.01};
  thick.upper = {0.012, 0.012, 0.012};
  thick.viscosity = 0.125;
  description.fluid_blocks.push_back(thick);
  const auto old = test::makeWorld(description, {});
  description.effects.viscosity->viscosity = 0.0625;
  const auto heir = test::makeWorld(description, {});
  ASSERT_TRUE(heir->adopt(*old).ok());
  const FrameBuffer frame = test::frameOf(*heir);
  std::size_t own = 0;
  for (const float viscosity : frame.viscosity) {
    if (viscosity == 0.125F) {
      ++own;
    } else {
      EXPECT_EQ(viscosity, 0.0625F);
    }
  }
  EXPECT_GT(own, 0u);
}

TEST(AdoptState, KeepsTheSpeedOfSoundItWasGiven) {
  WorldDescription weightless = pool();
  weightless.compressibility.max_fall_or_depth = 0.5;
  const auto old = test::makeWorld(weightless, {});
  weightless.effects.gravity.reset();
  EXPECT_LT(speedOfSound(weightless), old->speedOfSound());
  const auto heir = test::makeWorld(weightless, {.speed_of_sound = old->speedOfSound()});
  EXPECT_EQ(heir->speedOfSound(), old->speedOfSound());
  EXPECT_TRUE(heir->adopt(*old).ok());
  const auto other = test::makeWorld(weightless, {});
  EXPECT_EQ(other->adopt(*heir).code(), StatusCode::invalid_argument) << "another speed of sound";
}

TEST(AdoptState, RefusesAnotherBodyAndLeavesBothAsTheyAre) {
  const auto old = test::makeWorld(pool(), {});
  stir(*old);
  step(*old, 5);
  const std::uint64_t hash = old->stateHash();
  const auto refuse = [&](const std::function<void(WorldDescription&)>& change, const WorldOptions& options, StatusCode code) {
    WorldDescription other = pool();
    change(other);
    const auto heir = test::makeWorld(other, options);
    const std::uint64_t own = heir->stateHash();
    EXPECT_EQ(heir->adopt(*old).code(), code);
    EXPECT_EQ(heir->stateHash(), own);
    EXPECT_EQ(old->stateHash(), hash);
  };
  refuse([](WorldDescription& d) { d.capacity += 1; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.domain.upper.x() += 0.01; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.support_ratio = 2.5; }, {}, StatusCode::invalid_argument);
  refuse([](WorldDescription&) {}, {.precision = Precision::float64}, StatusCode::invalid_argument);
  refuse([](WorldDescription& d) { d.effects.applied_force->max_sources = 0; }, {}, StatusCode::capacity);
}

}  // namespace
}  // namespace bleedsim::sph
