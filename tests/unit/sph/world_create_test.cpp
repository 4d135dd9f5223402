// createWorld: what it refuses and how; the speed of sound and the effects that a description stands for.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
using D = WorldDescription;

struct BadInput {
  const char* what;
  std::function<void(WorldDescription&)> change;
  StatusCode code = StatusCode::invalid_argument;
};

std::vector<BadInput> badInputs() {
  std::vector<BadInput> all{
      {"capacity 0", [](D& d) { d.capacity = 0; }},
      {"capacity beyond the bound", [](D& d) { d.capacity = 0xffffffffu; }},
      {"blocks beyond the capacity", [](D& d) { d.capacity = 63; }, StatusCode::capacity},
      {"a block whose product overflows", [](D& d) { d.fluid_blocks[0].upper.setConstant(1e9); }, StatusCode::capacity},
      {"spacing 0", [](D& d) { d.spacing = 0.0; }},
      {"spacing negative", [](D& d) { d.spacing = -0.001; }},
      {"spacing tiny", [](D& d) { d.spacing = 1e-9; }},
      {"support ratio small", [](D& d) { d.support_ratio = 1.4; }},
      {"support ratio large", [](D& d) { d.support_ratio = 3.6; }},
      {"density 0", [](D& d) { d.rest_density = 0.0; }},
      {"max_dt 0", [](D& d) { d.max_dt = 0.0; }},
      {"max_dt negative", [](D& d) { d.max_dt = -kInfinity; }},
      {"no speed of sound", [](D& d) { d.compressibility.design_speed = 0.0; }},
      {"mach factor 0", [](D& d) { d.compressibility.mach_factor = 0.0; }},
      {"mach factor negative", [](D& d) { d.compressibility.mach_factor = -10.0; }},
      {"domain empty", [](D& d) { d.domain.upper = d.domain.lower; }},
      {"domain inside out", [](D& d) { d.domain.upper.y() = -1.0; }},
      {"domain huge", [](D& d) { d.domain.upper.setConstant(1e6); }},
      {"periodic side narrow",
       [](D& d) {
         d.domain.periodic[1] = true;
         d.domain.lower.y() = 0.0;
         d.domain.upper.y() = 0.0059;
       }},
      {"viscosity negative", [](D& d) { d.effects.viscosity->viscosity = -0.001; }},
      {"block viscosity negative", [](D& d) { d.fluid_blocks[0].viscosity = -0.001; }},
      {"force sources without bound", [](D& d) { d.effects.applied_force = AppliedForceSettings{0xffffffffu}; }},
      {"wound outside", [](D& d) { d.wounds[0].position.z() = 1.0; }},
      {"wound not finite", [](D& d) { d.wounds[0].drive = FlowDrive{kNan}; }},
      {"wound too fast", [](D& d) { d.wounds[0].drive = FlowDrive{1.0}; }},
      {"wounds over each other", [](D& d) { d.wounds.push_back(d.wounds[0]); }},
      {"more wounds than allowed", [](D& d) { d.max_wounds = 0; }, StatusCode::capacity},
      {"tissue slip", [](D& d) { d.tissue[0].slip = 1.5; }},
      {"tissue normal",
       [](D& d) {
         d.tissue[0].shape = PlaneShape{Vec3::Zero(), Vec3::Zero()};
       }},
      {"tissue box", [](D& d) { d.tissue[0].shape = BoxShape{}; }},
      {"tissue bowl",
       [](D& d) {
         d.tissue[0].shape = BowlShape{Vec3::Zero(), 0.01, 0.02};
       }},
  };
  for (const double bad : {kNan, kInfinity}) {
    all.push_back({"spacing not finite", [bad](D& d) { d.spacing = bad; }});
    all.push_back({"support ratio not finite", [bad](D& d) { d.support_ratio = bad; }});
    all.push_back({"density not finite", [bad](D& d) { d.rest_density = bad; }});
    all.push_back({"design speed not finite", [bad](D& d) { d.compressibility.design_speed = bad; }});
    all.push_back({"depth not finite", [bad](D& d) { d.compressibility.max_fall_or_depth = bad; }});
    all.push_back({"mach factor not finite", [bad](D& d) { d.compressibility.mach_factor = bad; }});
    all.push_back({"domain not finite", [bad](D& d) { d.domain.upper.z() = bad; }});
    all.push_back({"gravity not finite", [bad](D& d) { d.effects.gravity->acceleration.x() = bad; }});
    all.push_back({"background pressure not finite", [bad](D& d) { d.effects.pressure->background_pressure = bad; }});
    all.push_back({"viscosity not finite", [bad](D& d) { d.effects.viscosity->viscosity = bad; }});
    all.push_back({"block corner not finite", [bad](D& d) { d.fluid_blocks[0].lower.x() = bad; }});
    all.push_back({"block velocity not finite", [bad](D& d) { d.fluid_blocks[0].velocity.x() = bad; }});
    all.push_back({"block jitter not finite", [bad](D& d) { d.fluid_blocks[0].jitter = bad; }});
    all.push_back({"block viscosity not finite", [bad](D& d) { d.fluid_blocks[0].viscosity = bad; }});
    all.push_back({"tissue point not finite", [bad](D& d) { d.tissue[0].shape = PlaneShape{Vec3::Constant(bad)}; }});
  }
  all.push_back({"max_dt not a number", [](D& d) { d.max_dt = kNan; }});
  return all;
}

WorldDescription goodInput() {
  WorldDescription description = test::woundOnPlane(0.002, 1e-6);
  FluidBlock block;
  block.lower = {0.01, 0.01, 0.0};
  block.upper = {0.014, 0.014, 0.004};
  description.fluid_blocks.push_back(block);
  return description;
}

TEST(CreateWorld, RefusesBadInputWithAReason) {
  ASSERT_TRUE(createWorld(goodInput(), {}).ok());
  for (const BadInput& bad : badInputs()) {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
      WorldDescription description = goodInput();
      bad.change(description);
      const auto world = createWorld(description, {.precision = precision});
      ASSERT_FALSE(world.ok()) << bad.what;
      EXPECT_EQ(world.status().code(), bad.code) << bad.what << ": " << world.status().message();
      EXPECT_GT(world.status().message().size(), 20u) << bad.what;
    }
  }
}

TEST(CreateWorld, NamesTheWoundThatIsWrong) {
  WorldDescription description = goodInput();
  description.wounds[0].name = "left";
  description.wounds[0].normal.setZero();
  const auto world = createWorld(description, {});
  ASSERT_FALSE(world.ok());
  EXPECT_NE(world.status().message().find("'left'"), std::string::npos) << world.status().message();
}

TEST(CreateWorld, RefusesBadOptions) {
  for (const int threads : {0, -1, 65, std::numeric_limits<int>::max()}) {
    const auto world = createWorld(goodInput(), {.threads = threads});
    ASSERT_FALSE(world.ok()) << threads;
    EXPECT_EQ(world.status().code(), StatusCode::invalid_argument);
    EXPECT_NE(world.status().message().find(std::to_string(threads)), std::string::npos);
  }
  for (const SimdTarget target : {SimdTarget::avx2, SimdTarget::avx512}) {
    const auto world = createWorld(goodInput(), {.simd = target, .precision = Precision::float64});
    ASSERT_FALSE(world.ok());
    EXPECT_EQ(world.status().code(), StatusCode::invalid_argument);
  }
  const std::vector<SimdTarget> available = availableSimdTargets();
  for (const SimdTarget target : {SimdTarget::scalar, SimdTarget::avx2, SimdTarget::avx512}) {
    const auto world = createWorld(goodInput(), {.simd = target});
    const bool known = std::find(available.begin(), available.end(), target) != available.end();
    EXPECT_EQ(world.ok(), known) << simdTargetName(target);
    if (!known) { EXPECT_EQ(world.status().code(), StatusCode::unsupported); }
  }
  EXPECT_TRUE(createWorld(goodInput(), {.threads = 64, .simd = SimdTarget::scalar, .precision = Precision::float64}).ok());
}

TEST(CreateWorld, TheSeedDecidesTheJitter) {
  WorldDescription description = test::freeBlock({5, 5, 5}, 0.3);
  const std::uint64_t hash = test::makeWorld(description)->stateHash();
  EXPECT_EQ(test::makeWorld(description)->stateHash(), hash);
  description.seed = 2;
  EXPECT_NE(test::makeWorld(description)->stateHash(), hash);
}

TEST(CreateWorld, BlocksStandOnALatticeWithinTheirFaces) {
  WorldDescription description = test::emptyScene();
  FluidBlock block;
  block.lower = {0.0, 0.001, 0.002};
  block.upper = {0.0039, 0.003, 0.003};
  block.velocity = {0.1, 0.2, 0.3};
  description.fluid_blocks = {block};
  const FrameBuffer frame = test::frameOf(*test::makeWorld(description));
  ASSERT_EQ(frame.count, 6u) << "whole spacings: 3 x 2 x 1";
  std::set<std::uint32_t> ids;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const Vec3 in_spacings = test::positionOf(frame, i) / test::kSpacing;
    EXPECT_NEAR(in_spacings.x() - std::floor(in_spacings.x()), 0.5, 1e-5);
    EXPECT_NEAR(in_spacings.z(), 2.5, 1e-5);
    EXPECT_LT((test::velocityOf(frame, i) - block.velocity).norm(), 1e-7);
    ids.insert(frame.id[i]);
  }
  EXPECT_EQ(ids, (std::set<std::uint32_t>{1, 2, 3, 4, 5, 6}));
}

TEST(SpeedOfSound, IsTheLargestOfItsThreeSpeeds) {
  WorldDescription description = test::emptyScene();
  description.compressibility = {.mach_factor = 10.0, .design_speed = 0.3, .max_fall_or_depth = 0.0};
  EXPECT_DOUBLE_EQ(speedOfSound(description), 3.0);
  description.compressibility.max_fall_or_depth = 0.05;
  EXPECT_DOUBLE_EQ(speedOfSound(description), 3.0) << "no gravity, no fall";
  description.effects.gravity.emplace();
  EXPECT_NEAR(speedOfSound(description), 10.0 * std::sqrt(2.0 * 9.81 * 0.05), 1e-12);
  description.wounds.push_back(test::discWound(0.002, 1e-6));
  EXPECT_NEAR(speedOfSound(description), 10.0 * std::sqrt(2.0 * 9.81 * 0.05), 1e-12) << "a flow sets no speed";
  description.wounds[0].drive = PressureDriveSettings{2000.0, 0.61};
  EXPECT_NEAR(speedOfSound(description), 10.0 * std::sqrt(2.0 * 2000.0 / 1060.0), 1e-12);
  description.compressibility.mach_factor = 20.0;
  EXPECT_NEAR(speedOfSound(description), 20.0 * std::sqrt(2.0 * 2000.0 / 1060.0), 1e-12);
  description.compressibility.design_speed = 4.0;
  EXPECT_DOUBLE_EQ(speedOfSound(description), 80.0);
}

TEST(Effects, TheCatalogueNamesEachWithItsSource) {
  std::set<std::string_view> names;
  for (const EffectInfo& effect : effectCatalog()) {
    EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
    EXPECT_FALSE(effect.equation.empty());
    EXPECT_FALSE(effect.source.empty());
    EXPECT_FALSE(effect.deviation.empty());
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"gravity", "pressure", "viscosity", "platelets", "surface_tension", "core_radius",
                                               "repulsion", "adhesion", "applied_force", "wetting", "slip"}));
}

TEST(Effects, TheirSettingsEnableThem) {
  WorldDescription description;
  for (const EffectInfo& effect : effectCatalog()) EXPECT_FALSE(effectEnabled(description, effect.name)) << effect.name;
  const auto only_enabled = [&](std::string_view name) {
    for (const EffectInfo& effect : effectCatalog()) {
      EXPECT_EQ(effectEnabled(description, effect.name), effect.name == name) << effect.name;
    }
    description.effects = {};
  };
  description.effects.gravity.emplace();
  only_enabled("gravity");
  description.effects.pressure.emplace();
  only_enabled("pressure");
  description.effects.viscosity.emplace();
  only_enabled("viscosity");
  description.effects.core_radius.emplace();
  only_enabled("core_radius");
  description.effects.repulsion.emplace();
  only_enabled("repulsion");
  description.effects.applied_force.emplace();
  only_enabled("applied_force");
  description.effects.surface_tension.emplace();
  only_enabled("surface_tension");
  description.effects.adhesion.emplace();
  only_enabled("adhesion");
  description.tissue.push_back({.name = "plane", .shape = PlaneShape{}, .slip = 0.1});
  only_enabled("slip");
  description.tissue[0].slip = 0.0;
  description.effects.surface_tension.emplace().contact_angle = 1.0;
  EXPECT_TRUE(effectEnabled(description, "wetting"));
  EXPECT_TRUE(effectEnabled(description, "surface_tension"));
  EXPECT_FALSE(effectEnabled(description, "slip"));
  EXPECT_FALSE(effectEnabled(description, ""));
}

}  // namespace
}  // namespace bleedsim::sph
