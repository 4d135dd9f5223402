// Every SIMD target is the scalar twin to rounding whatever the set of effects: what acts beside the pair loop of the sound
// model, in all combinations on tissue, and all sets of the paper's terms. The pair loop's own sets stand in world_simd_test.cpp.
#include <gtest/gtest.h>
#include <tuple>

#include "tests/unit/sph/frame_differences.h"
#include "tests/unit/sph/literal_scenes.h"

namespace bleedsim::sph {
namespace {

/// One step on every other target against one on the scalar twin. `prepare` acts on each world before it.
template <class Prepare>
void expectTwins(const WorldDescription& description, const std::string& what, const Prepare& prepare) {
  const auto step_on = [&](SimdTarget target) {
    auto world = test::makeWorld(description, {.simd = target});
    prepare(*world);
    EXPECT_TRUE(world->step(1.0).ok()) << what;
    EXPECT_EQ(test::counterOf(*world, Counter::viscosity_unsolved), 0u) << what;
    return test::frameOf(*world);
  };
  const FrameBuffer expected = step_on(SimdTarget::scalar);
  for (const SimdTarget target : availableSimdTargets()) {
    if (target == SimdTarget::scalar) continue;
    expectAlike(step_on(target), expected, what + " on " + std::string{simdTargetName(target)});
  }
}

enum class Surface { none, tension, contact_angle };
enum class Law { newtonian, carreau, casson };
using Sound = std::tuple<Surface, bool, Law, ViscositySolve>;  // adhesion second

/// A block of blood that slides over a plane under gravity.
WorldDescription onTissue(const Sound& effects) {
  const auto& [surface, adhesion, law, solve] = effects;
  WorldDescription description = test::freeBlock({8, 8, 6}, 0.2);
  description.capacity = 400;
  FluidBlock& block = description.fluid_blocks.front();
  block.upper.z() -= block.lower.z();
  block.lower.z() = 0.0;
  block.velocity = {0.1, -0.2, 0.05};
  description.domain.lower.z() = -0.01;
  description.tissue.push_back({.name = "plane", .shape = PlaneShape{}, .slip = 0.3});
  description.effects.gravity.emplace();
  if (surface != Surface::none) description.effects.surface_tension.emplace();
  if (surface == Surface::contact_angle) description.effects.surface_tension->contact_angle = 0.7;
  if (adhesion) description.effects.adhesion.emplace();
  ViscositySettings& viscosity = *description.effects.viscosity;
  if (law == Law::carreau) viscosity.rheology = CarreauYasudaRheology{};
  if (law == Law::casson) viscosity.rheology = CassonRheology{};
  viscosity.solve = solve;
  return description;
}

class EverySoundEffect : public testing::TestWithParam<Sound> {};

TEST_P(EverySoundEffect, IsThatOfTheScalarTwin) {
  for (int bits = 0; bits < 8; ++bits) {
    WorldDescription description = onTissue(GetParam());
    const bool pushed = (bits & 1) != 0;
    const bool radius = (bits & 2) != 0;
    const bool clots = (bits & 4) != 0;
    if (pushed) description.effects.applied_force.emplace();
    if (radius) description.effects.core_radius.emplace();
    if (clots) description.effects.platelets.emplace();
    const std::string what =
        std::string{pushed ? "pushed " : ""} + (radius ? "with own radii " : "") + (clots ? "with platelets" : "");
    expectTwins(description, what, [pushed](World& world) {
      if (!pushed) return;
      SetForce force;
      force.key = 1;
      force.position = {0.0, 0.0, 0.004};
      force.radius = 0.003;
      force.force = {0.001, 0.002, -0.001};
      ASSERT_TRUE(world.apply(force).ok());
    });
  }
}

std::string nameOf(const testing::TestParamInfo<Sound>& tested) {
  constexpr std::array<const char*, 3> kSurfaces{"NoTension", "Tension", "ContactAngle"};
  constexpr std::array<const char*, 3> kLaws{"Newtonian", "Carreau", "Casson"};
  return std::string{kSurfaces[static_cast<std::size_t>(std::get<0>(tested.param))]} +
         (std::get<1>(tested.param) ? "Adhesion" : "") + kLaws[static_cast<std::size_t>(std::get<2>(tested.param))] +
         (std::get<3>(tested.param) == ViscositySolve::implicit ? "Implicit" : "Explicit");
}

INSTANTIATE_TEST_SUITE_P(OnTissue, EverySoundEffect,
                         testing::Combine(testing::Values(Surface::none, Surface::tension, Surface::contact_angle),
                                          testing::Bool(), testing::Values(Law::newtonian, Law::carreau, Law::casson),
                                          testing::Values(ViscositySolve::explicit_, ViscositySolve::implicit)),
                         [](const auto& tested) { return nameOf(tested); });

class EveryLiteralSet : public testing::TestWithParam<LiteralSet> {};

// Two halves that meet, of different age. Nothing may stand at a distance at which Table I's branch, which jumps, could go either
// way by rounding: the jitter's places don't.
TEST_P(EveryLiteralSet, IsThatOfTheScalarTwin) {
  for (const WorldDescription& base : {test::freeBlock({8, 8, 8}, 0.2), test::periodicBox({12, 12, 12}, 0.2)}) {
    WorldDescription description = literal(base, GetParam());
    description.capacity = 1800;
    description.literal.platelet_diffusivity = 1e-4;
    FluidBlock& first = description.fluid_blocks.front();
    FluidBlock second = first;
    first.velocity = {0.1, -0.2, 0.05};
    first.upper.x() = second.lower.x() = 0.5 * (first.lower.x() + first.upper.x());
    if (GetParam().platelets) second.platelet = 0.4;
    description.fluid_blocks.push_back(second);
    expectTwins(description, "", [](World&) {});
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryLiteralSet, testing::ValuesIn(allLiteralSets()),
                         [](const auto& tested) { return nameOf(tested.param); });

}  // namespace
}  // namespace bleedsim::sph
