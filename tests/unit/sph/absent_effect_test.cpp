// Simulate only what the scene calls for: what an effect adds in arrays, frame bytes and compiled code, and that its absence
// takes none of it. Every effect that this build knows, in both models.
#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "service/sph/effects/effect_list.h"
#include "service/sph/effects/literal_list.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

/// Parts of MemoryUse that grow with an effect.
struct Arrays {
  bool particles = false;
  bool passes = false;  ///< more fields in the packed record
  bool lists = false;
  bool effects = false;
};

/// What an effect is made of, beside pressure and viscosity in a box of tissue.
struct Parts {
  std::string_view effect;
  bool density = false;      ///< another instantiation of the density pass
  bool pair_forces = false;  ///< another instantiation of the fused pair loop
  bool shear_rate = false;   ///< a sweep that does not run without it
  bool diffusion = false;    ///< another
  bool curvature = false;    ///< and another
  Arrays arrays = {};
};

// gravity is a constant of the kick and adhesion one of the tissue's force: they own neither code nor arrays.
const std::vector<Parts> kSound{
    {.effect = "gravity"},
    {.effect = "pressure", .pair_forces = true},
    {.effect = "viscosity", .pair_forces = true, .arrays = {.passes = true}},
    {.effect = "platelets",
     .pair_forces = true,
     .shear_rate = true,
     .diffusion = true,
     .arrays = {.particles = true, .passes = true, .effects = true}},
    {.effect = "core_radius", .density = true, .pair_forces = true, .arrays = {.particles = true, .passes = true, .lists = true}},
    {.effect = "repulsion", .pair_forces = true},
    {.effect = "surface_tension", .pair_forces = true, .curvature = true, .arrays = {.passes = true, .effects = true}},
    {.effect = "adhesion"},
    {.effect = "applied_force", .arrays = {.effects = true}}};

// The paper's terms all stand in one loop; its viscosity reads the third group of the record, which others then share.
const std::vector<Parts> kLiteral{
    {.effect = "gravity"},
    {.effect = "pressure", .pair_forces = true},
    {.effect = "viscosity", .pair_forces = true, .arrays = {.passes = true}},
    {.effect = "platelets", .pair_forces = true, .arrays = {.particles = true}},
    {.effect = "core_radius", .density = true, .pair_forces = true, .arrays = {.particles = true, .lists = true}},
    {.effect = "repulsion", .pair_forces = true},
    {.effect = "surface_tension", .pair_forces = true},
    {.effect = "applied_force", .arrays = {.effects = true}}};

struct Case {
  Model model;
  Parts parts;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Parts& parts : kSound) all.push_back({Model::sound, parts});
  for (const Parts& parts : kLiteral) all.push_back({Model::literal, parts});
  return all;
}

WorldDescription box(Model model) {
  WorldDescription description = test::closedBox({6, 6, 6});
  description.capacity = 300;
  description.model = model;
  return description;
}

/// Of a frame with `attributes`, bytes.
std::size_t frameBytes(const World& world, std::uint32_t attributes) {
  FrameBuffer frame;
  frame.reserve(world.description().capacity, attributes);
  world.copyFrame(frame, attributes);
  EXPECT_EQ(frame.attributes, attributes);
  return 4 * (frame.position.size() + frame.id.size() + frame.velocity.size() + frame.density.size() + frame.viscosity.size() +
              frame.platelet.size() + frame.radius.size());
}

class AbsentEffect : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Parts& parts = GetParam().parts;
    const auto row =
        std::find_if(kEffects.begin(), kEffects.end(), [&](const EffectRow& e) { return e.info.name == parts.effect; });
    ASSERT_NE(row, kEffects.end());
    WorldDescription description = box(GetParam().model);
    row->slot.remove(description.effects);
    without_ = test::makeWorld(description);
    row->slot.add(description.effects, {});
    with_ = test::makeWorld(description);
    for (World* world : {without_.get(), with_.get()}) ASSERT_TRUE(world->step(1.0).ok());
  }

  std::unique_ptr<World> without_, with_;
};

TEST_P(AbsentEffect, HasNoArrays) {
  const Arrays& grows = GetParam().parts.arrays;
  const MemoryUse less = without_->memory();
  const MemoryUse more = with_->memory();
  const auto compare = [](bool grow, std::size_t absent, std::size_t present, const char* what) {
    if (grow) {
      EXPECT_LT(absent, present) << what;
    } else {
      EXPECT_EQ(absent, present) << what;
    }
  };
  EXPECT_EQ(less.effects, 0u);
  compare(grows.particles, less.particles, more.particles, "particles");
  compare(grows.passes, less.passes, more.passes, "passes");
  compare(grows.lists, less.lists, more.lists, "lists");
  compare(grows.effects, less.effects, more.effects, "effects");
  EXPECT_EQ(less.tissue, more.tissue);
}

TEST_P(AbsentEffect, IsNoPartOfTheCodeThatRuns) {
  const Parts& parts = GetParam().parts;
  const RunningCode less = without_->runningCode();
  const RunningCode more = with_->runningCode();
  EXPECT_NE(less.density, 0u);
  EXPECT_NE(less.pair_forces, 0u);
  EXPECT_EQ(less.density != more.density, parts.density);
  EXPECT_EQ(less.pair_forces != more.pair_forces, parts.pair_forces);
  EXPECT_EQ(less.shear_rate, 0u);
  EXPECT_EQ(more.shear_rate != 0, parts.shear_rate);
  EXPECT_EQ(less.platelets, 0u);
  EXPECT_EQ(more.platelets != 0, parts.diffusion);
  EXPECT_EQ(less.curvature, 0u);
  EXPECT_EQ(more.curvature != 0, parts.curvature);
  EXPECT_EQ(less.viscous_product, 0u);
}

TEST_P(AbsentEffect, TakesNoByteOfAFrameUnlessItsAttributeIsAskedFor) {
  for (const std::uint32_t attributes : {0u, static_cast<unsigned>(kFrameVelocity | kFrameDensity)}) {
    EXPECT_EQ(frameBytes(*with_, attributes), frameBytes(*without_, attributes));
    for (const FrameAttribute own : {kFrameViscosity, kFramePlatelet, kFrameRadius}) {
      EXPECT_EQ(frameBytes(*with_, attributes | own), frameBytes(*with_, attributes) + 4 * std::size_t{300});
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, AbsentEffect, testing::ValuesIn(cases()), [](const auto& tested) {
  return std::string{tested.param.model == Model::literal ? "literal_" : "sound_"} + std::string{tested.param.parts.effect};
});

TEST(AbsentEffects, AreCheckedOneByOne) {
  ASSERT_EQ(kSound.size(), kEffects.size());
  for (std::size_t k = 0; k < kEffects.size(); ++k) {
    const auto named = [k](const Parts& parts) { return parts.effect == kEffects[k].info.name; };
    EXPECT_TRUE(std::any_of(kSound.begin(), kSound.end(), named)) << kEffects[k].info.name;
    EXPECT_EQ(std::any_of(kLiteral.begin(), kLiteral.end(), named), !literalText(kEffects[k].info.name).empty());
  }
}

// What viscosity brings only where it is asked for: the shear rate of a rheology, the solver's product.
TEST(AbsentVariant, OfViscosityIsNoPartOfTheCodeThatRuns) {
  const auto code_of = [](auto&& change) {
    WorldDescription description = box(Model::sound);
    change(*description.effects.viscosity);
    const auto world = test::makeWorld(description);
    EXPECT_TRUE(world->step(1.0).ok());
    return world->runningCode();
  };
  const RunningCode plain = code_of([](ViscositySettings&) {});
  const RunningCode casson = code_of([](ViscositySettings& v) { v.rheology = CassonRheology{}; });
  EXPECT_EQ(plain.shear_rate, 0u);
  EXPECT_NE(casson.shear_rate, 0u);
  EXPECT_NE(casson.pair_forces, plain.pair_forces) << "viscosity that differs between particles";
  const RunningCode solved = code_of([](ViscositySettings& v) { v.solve = ViscositySolve::implicit; });
  EXPECT_EQ(plain.viscous_product, 0u);
  EXPECT_NE(solved.viscous_product, 0u);
  EXPECT_NE(solved.pair_forces, plain.pair_forces) << "the pair loop has no viscosity where it is solved";
}

}  // namespace
}  // namespace bleedsim::sph
