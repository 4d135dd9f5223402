// The literal model and planar worlds as worlds: what runs, what is refused, integration, platelets in time.
#include <gtest/gtest.h>
#include <limits>

#include "tests/unit/sph/literal_scenes.h"

namespace bleedsim::sph {
namespace {

constexpr LiteralSet kEverything{PressureTerm::symmetric, true, true, true, true, true};
constexpr double kFree = std::numeric_limits<double>::infinity();

void step(World& world, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Status status = world.step(kFree);
    ASSERT_TRUE(status.ok()) << status.message();
  }
}

class LiteralWorld : public testing::TestWithParam<LiteralSet> {};

TEST_P(LiteralWorld, RunsToTheSameBitsOnOneAndTwoThreads) {
  WorldDescription description = literal(test::freeBlock({13, 13, 13}, 0.2), GetParam());
  description.effects.gravity.emplace();
  const auto one = test::makeWorld(description, {.threads = 1});
  const auto two = test::makeWorld(description, {.threads = 2});
  ASSERT_GT(one->particleCount(), 2000u) << "too few particles for a second thread";
  step(*one, 4);
  step(*two, 4);
  EXPECT_EQ(one->stateHash(), two->stateHash());
  EXPECT_FALSE(one->faulted());
}

INSTANTIATE_TEST_SUITE_P(AllSets, LiteralWorld, testing::ValuesIn(allLiteralSets()),
                         [](const testing::TestParamInfo<LiteralSet>& tested) { return nameOf(tested.param); });

// v += g dt, x += v dt: after n steps of dt, x = g dt^2 n (n+1)/2, where kick-drift-kick has g t^2/2. Exact but for rounding.
TEST(LiteralStep, IsSymplecticEuler) {
  WorldDescription description = literal(test::freeBlock({1, 1, 1}), {.pressure = PressureTerm::symmetric});
  description.effects.gravity.emplace();
  description.max_dt = 1e-5;
  const WorldOptions reference{.precision = Precision::float64};
  const auto world = test::makeWorld(description, reference);
  const double start = test::statsOf(*world).center.z();
  step(*world, 10);
  const double fallen = start - test::statsOf(*world).center.z();
  EXPECT_NEAR(fallen, 9.81 * 1e-10 * 55.0, 1e-9 * fallen);
  description.model = Model::sound;
  const auto sound = test::makeWorld(description, reference);
  step(*sound, 10);
  EXPECT_NEAR(start - test::statsOf(*sound).center.z(), 9.81 * 1e-10 * 50.0, 1e-9 * fallen);
}

TEST(LiteralStep, FollowsItsOwnStiffness) {
  WorldDescription description = literal(test::freeBlock({3, 3, 3}), kEverything);
  EXPECT_EQ(speedOfSound(description), 5.0);
  description.literal.stiffness = 4.0;
  const auto world = test::makeWorld(description);
  EXPECT_EQ(world->speedOfSound(), 2.0);
}

TEST(LiteralStep, CalibratesTheMassWithPoly6) {
  // physics.md section 1: the lattice sum of poly6 is 1 % high at h = 2 dx.
  const auto world = test::makeWorld(literal(test::freeBlock({3, 3, 3}), kEverything));
  EXPECT_NEAR(world->particleMass() * 1e9 / test::kRestDensity, 0.990, 0.002);
}

double meanViscosity(const World& world) {
  const FrameBuffer frame = test::frameOf(world);
  double sum = 0.0;
  for (const float viscosity : frame.viscosity) sum += static_cast<double>(viscosity);
  return sum / frame.count;
}

// (27) is a diffusion: where P is uniform it does nothing, so (26) never thickens. To the bit: P_j - P_i = 0.
TEST(LiteralPlatelets, UniformPNeverClots) {
  WorldDescription description = literal(test::freeBlock({8, 8, 8}, 0.2), kEverything);
  description.literal.platelet_diffusivity = 1e-4;
  const auto world = test::makeWorld(description);
  const std::vector<float> before = test::frameOf(*world).viscosity;
  EXPECT_NEAR(before.front(), description.effects.viscosity->viscosity, 1e-6 * 0.00345) << "fresh blood has the scene's mu";
  step(*world, 200);
  EXPECT_EQ(test::frameOf(*world).viscosity, before);
}

// Jensen: b exp(-a P) is convex, so what diffuses away from a clot makes the whole thinner, not thicker. Clotted half P = 0.3.
TEST(LiteralPlatelets, DiffusionThinsTheWhole) {
  WorldDescription description = literal(test::periodicBox({8, 8, 8}), {.viscosity = true, .platelets = true});
  FluidBlock& fresh = description.fluid_blocks.front();
  FluidBlock clot = fresh;
  fresh.upper.x() = clot.lower.x() = 0.5 * fresh.upper.x();
  clot.platelet = 0.3;
  description.fluid_blocks.push_back(clot);
  description.literal.platelet_diffusivity = 1e-5;
  const auto world = test::makeWorld(description);
  const double before = meanViscosity(*world);
  const double a = std::log(10.0 / 0.00345) / 0.99;
  EXPECT_NEAR(before, 0.5 * (0.00345 + 10.0 * std::exp(-a * 0.3)), 1e-5 * before);
  step(*world, 400);
  EXPECT_GT(world->time() * 1e-5, 1e-8) << "too short for a diffusion over a tenth of a millimetre";
  EXPECT_LT(meanViscosity(*world), 0.95 * before);
}

// The model stands in a world with a wound and tissue: emission is exact to a particle, and its unclamped forces fault nothing.
TEST(LiteralTissue, BleedsOnAPlane) {
  for (const LiteralSet set : {kEverything, LiteralSet{PressureTerm::symmetric, false, true, false, false}}) {
    const auto world = test::makeWorld(literal(test::woundOnPlane(0.003, 12e-6), set));
    for (int k = 0; k < 1500; ++k) ASSERT_TRUE(world->step(kFree).ok());
    const WorldStats stats = test::statsOf(*world);
    EXPECT_GT(stats.particles, 300u);
    EXPECT_EQ(stats.particles, stats.injected - stats.removed);
    EXPECT_NEAR(stats.emitted_volume, stats.commanded_volume, 1e-9);
    RecordProperty(nameOf(set) + "_clamped", std::to_string(stats.counters[static_cast<std::size_t>(Counter::speed_clamped)]));
    RecordProperty(nameOf(set) + "_projected",
                   std::to_string(stats.counters[static_cast<std::size_t>(Counter::tissue_projected)]));
    RecordProperty(nameOf(set) + "_max_speed", std::to_string(stats.max_speed));
  }
}

StatusCode refusalOf(const WorldDescription& description, std::string_view part) {
  const auto world = createWorld(description, {});
  EXPECT_FALSE(world.ok()) << part;
  EXPECT_NE(world.status().message().find(part), std::string::npos) << world.status().message();
  return world.status().code();
}

TEST(LiteralRefusal, SaysWhatThePaperDoesNotHave) {
  const WorldDescription good = literal(test::freeBlock({3, 3, 3}), kEverything);
  ASSERT_TRUE(createWorld(good, {}).ok());
  const auto expect = [&](std::string_view part, auto&& change) {
    WorldDescription description = good;
    change(description);
    EXPECT_EQ(refusalOf(description, part), StatusCode::unsupported);
  };
  expect("adhesion", [](WorldDescription& d) { d.effects.adhesion.emplace(); });
  expect("background", [](WorldDescription& d) { d.effects.pressure->background_pressure = 10.0; });
  expect("shear rate", [](WorldDescription& d) { d.effects.viscosity->rheology = CassonRheology{}; });
  expect("implicit", [](WorldDescription& d) { d.effects.viscosity->solve = ViscositySolve::implicit; });
  expect("contact angle", [](WorldDescription& d) { d.effects.surface_tension->contact_angle = 0.7; });
}

TEST(LiteralRefusal, NamesNumbersOutOfRange) {
  const WorldDescription good = literal(test::freeBlock({3, 3, 3}), kEverything);
  const auto expect = [&](std::string_view part, auto&& change) {
    WorldDescription description = good;
    change(description.literal);
    EXPECT_EQ(refusalOf(description, part), StatusCode::invalid_argument);
  };
  expect("stiffness", [](LiteralSettings& s) { s.stiffness = 0.0; });
  expect("tension", [](LiteralSettings& s) { s.tension = -1.0; });
  expect("normal_cutoff", [](LiteralSettings& s) { s.normal_cutoff = std::nan(""); });
  expect("thickening:", [](LiteralSettings& s) { s.thickening = 0.0; });
  expect("thickening_exponent", [](LiteralSettings& s) { s.thickening_exponent = -1.0; });
  expect("diffusivity", [](LiteralSettings& s) { s.platelet_diffusivity = kFree; });
  expect("repulsion", [](LiteralSettings& s) { s.repulsion = -1.0; });
  expect("power", [](LiteralSettings& s) { s.power_1 = 4; });
  expect("contact_radius", [](LiteralSettings& s) { s.contact_radius = 1.2; });
}

TEST(Planar, RestLatticeHasTheRestDensityAndStaysWhereItIs) {
  for (const Model model : {Model::sound, Model::literal}) {
    WorldDescription description = layer(10, 9);
    description.domain.lower = {-0.005, -0.0045, -0.01};
    description.domain.upper = {0.005, 0.0045, 0.01};
    description.domain.periodic = {true, true, false};
    description.model = model;
    const auto world = test::makeWorld(description);
    // A layer of thickness dx holds rho0 dx^3 a particle but for the lattice sum, which is 3.8 % high for Wendland at h = 2 dx.
    EXPECT_NEAR(world->particleMass() * 1e9 / test::kRestDensity, 1.0, 0.05);
    for (const float density : test::frameOf(*world).density) EXPECT_NEAR(density, test::kRestDensity, 1e-4 * test::kRestDensity);
    const Vec3 before = test::positionOf(test::frameOf(*world), 0);
    step(*world, 50);
    // Rounding of the densities, 1e-7 of c0^2/dx over (50 x 40 us)^2, moves nothing by more than a micrometre.
    EXPECT_LT((test::positionOf(test::frameOf(*world), 0) - before).norm(), 1e-5);
  }
}

TEST(Planar, SoundPassesEqualBruteForce) {
  for (const PairSet set : {PairSet{PressureTerm::variational, ViscosityTerm::uniform, false, true},
                            PairSet{PressureTerm::symmetric, ViscosityTerm::harmonic, false, false}}) {
    const WorldDescription description = withPairSet(layer(13, 12, 0.3), set);
    const PassRig<double> rig{description, SimdTarget::scalar, stirredLayer(description)};
    const test::OracleFields oracle = test::bruteForce(description, set, rig.rounded());
    ASSERT_GT(largestNorm(oracle.acceleration), 1.0);
    EXPECT_LT(largestRelativeDifference(rig.density(), oracle.density), 1e-12);
    EXPECT_LE(largestDifference(rig.acceleration(), oracle.acceleration), 1e-12 * largestNorm(oracle.acceleration));
  }
}

TEST(Planar, LayerNeverLeavesItsHeight) {
  for (const Model model : {Model::sound, Model::literal}) {
    WorldDescription description = layer(12, 11, 0.3);
    if (model == Model::literal) description = literal(description, kEverything);
    description.effects.gravity.emplace();
    description.effects.gravity->acceleration = {1.0, 0.0, -9.81};
    description.effects.applied_force.emplace();
    const auto world = test::makeWorld(description);
    SetForce force;
    force.key = 1;
    force.position = {0.0, 0.0, 0.0005};
    force.radius = 0.004;
    force.force = {0.0, 1e-4, 1e-4};
    ASSERT_TRUE(world->apply(force).ok());
    step(*world, 100);
    const FrameBuffer frame = test::frameOf(*world);
    const float height = static_cast<float>(static_cast<float>(0.0005 / 0.002) * 0.002f);
    for (std::size_t i = 0; i < frame.count; ++i) {
      EXPECT_EQ(frame.position[3 * i + 2], height);
      EXPECT_EQ(frame.velocity[3 * i + 2], 0.0f);
    }
    EXPECT_GT(test::statsOf(*world).max_speed, 1e-3);
  }
}

TEST(Planar, RefusesWhatHasThreeDimensions) {
  const WorldDescription good = layer(4, 4);
  ASSERT_TRUE(createWorld(good, {}).ok());
  const auto expect = [&](StatusCode code, std::string_view part, auto&& change) {
    WorldDescription description = good;
    change(description);
    EXPECT_EQ(refusalOf(description, part), code);
  };
  expect(StatusCode::unsupported, "tissue",
         [](WorldDescription& d) { d.tissue.push_back({.name = "plane", .shape = PlaneShape{}}); });
  expect(StatusCode::unsupported, "wounds", [](WorldDescription& d) { d.wounds.push_back(test::discWound(0.002, 1e-6)); });
  expect(StatusCode::unsupported, "surface tension", [](WorldDescription& d) { d.effects.surface_tension.emplace(); });
  expect(StatusCode::invalid_argument, "one particle high", [](WorldDescription& d) { d.fluid_blocks[0].upper.z() = 0.002; });
  expect(StatusCode::invalid_argument, "one height", [](WorldDescription& d) {
    d.fluid_blocks.push_back(d.fluid_blocks[0]);
    d.fluid_blocks[1].lower.z() = 0.001;
    d.fluid_blocks[1].upper.z() = 0.002;
  });
  expect(StatusCode::invalid_argument, "in the plane", [](WorldDescription& d) { d.fluid_blocks[0].velocity.z() = 0.1; });
}

TEST(EffectCatalog, SaysWhatEachEffectIsInTheLiteralModel) {
  for (const EffectInfo& info : effectCatalog()) {
    EXPECT_EQ(info.literal.empty(), info.name == "adhesion" || info.name == "wetting") << info.name;
  }
}

}  // namespace
}  // namespace bleedsim::sph
