// World::saveState and restoreState: a restored world goes on bit for bit as the saved one.
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

#include "service/sph/description_hash.h"
#include "tests/support/counting_new.h"
#include "tests/unit/sph/literal_scenes.h"
#include "tests/unit/sph/stirred_pool.h"

namespace bleedsim::sph {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes saved(const World& world) {
  Bytes room(world.stateBytes());
  EXPECT_EQ(world.saveState(room), room.size());
  return room;
}

void step(World& world, int count) {
  for (int i = 0; i < count; ++i) ASSERT_TRUE(world.step(1.0).ok());
}

void expectSameSteps(World& a, World& b, int count) {
  for (int i = 0; i < count; ++i) {
    ASSERT_TRUE(a.step(1.0).ok());
    ASSERT_TRUE(b.step(1.0).ok());
    ASSERT_EQ(a.time(), b.time()) << "after " << i + 1 << " steps";
    ASSERT_EQ(a.stateHash(), b.stateHash()) << "after " << i + 1 << " steps";
  }
}

/// A restored twin of `world` steps on like it, and so does one that comes of the twin.
void expectGoesOn(World& world, const WorldOptions& options, int steps = 40) {
  const Bytes state = saved(world);
  const auto heir = test::makeWorld(world.description(), options);
  const Status restored = heir->restoreState(state);
  ASSERT_TRUE(restored.ok()) << restored.message();
  EXPECT_EQ(heir->stateHash(), world.stateHash());
  expectSameFigures(*heir, world);
  EXPECT_EQ(saved(*heir), state);
  expectSameSteps(world, *heir, steps);
  expectSameFigures(*heir, world);
}

/// Everything of the sound model that keeps something between steps.
WorldDescription pool(int bits) {
  const auto has = [bits](int bit) { return (bits >> bit & 1) != 0; };
  WorldDescription scene = poolOf(0.008, 0.006, 0.1);
  if (has(0)) scene.effects.surface_tension.emplace();
  if (has(1)) scene.effects.platelets.emplace().clot_speedup = 100.0;
  if (has(2)) scene.effects.core_radius.emplace();
  if (has(3)) scene.effects.repulsion.emplace();
  if (has(4)) scene.effects.viscosity->rheology = CarreauYasudaRheology{};
  if (has(5)) scene.effects.viscosity->solve = ViscositySolve::implicit;
  if (has(6)) scene.effects.adhesion.emplace();
  if (has(7)) scene.fluid_blocks.front().viscosity = 0.02;
  return scene;
}

class EffectSets : public testing::TestWithParam<int> {};

TEST_P(EffectSets, GoOnAsIfNothingHadHappened) {
  const auto world = test::makeWorld(pool(GetParam()));
  stir(*world, 0.05);
  step(*world, 70);
  expectGoesOn(*world, {});
}

INSTANTIATE_TEST_SUITE_P(Sound, EffectSets,
                         testing::Values(0, 1, 2, 4, 8, 16, 32, 64, 128, 2 | 32, 1 | 4, 2 | 16, 4 | 16, 2 | 128, 255 & ~8, 255));

class LiteralSets : public testing::TestWithParam<LiteralSet> {};

TEST_P(LiteralSets, GoOnAsIfNothingHadHappened) {
  WorldDescription description = literal(test::freeBlock({6, 6, 6}, 0.2), GetParam());
  description.capacity = 1800;
  const auto world = test::makeWorld(description);
  step(*world, 12);
  expectGoesOn(*world, {}, 12);
}

INSTANTIATE_TEST_SUITE_P(All, LiteralSets, testing::ValuesIn(allLiteralSets()),
                         [](const auto& tested) { return nameOf(tested.param); });

TEST(WorldState, IsThatOfAnyNumberOfThreads) {
  WorldDescription scene = pool(255);
  FluidBlock& block = scene.fluid_blocks.front();
  block.lower.head<2>().setConstant(-0.012);
  block.upper.head<2>().setConstant(0.012);
  const auto one = test::makeWorld(scene, {.threads = 1});
  ASSERT_GT(one->particleCount(), 2000u) << "too few particles for a second thread";
  stir(*one);
  step(*one, 40);
  expectGoesOn(*one, {.threads = 2});
}

TEST(WorldState, InDoublePrecision) {
  const auto world = test::makeWorld(pool(255), {.precision = Precision::float64});
  stir(*world);
  step(*world, 40);
  expectGoesOn(*world, {.precision = Precision::float64}, 20);
}

TEST(WorldState, OfAPlanarAndOfAPeriodicWorld) {
  WorldDescription planar = test::freeBlock({8, 8, 1}, 0.1);
  planar.planar = true;
  const auto layer = test::makeWorld(planar);
  step(*layer, 20);
  expectGoesOn(*layer, {});
  const auto box = test::makeWorld(test::periodicBox({8, 8, 8}, 0.2));
  step(*box, 20);
  expectGoesOn(*box, {});
}

TEST(WorldState, KeepsWoundsThatWereMovedNamedAndRemoved) {
  const auto world = test::makeWorld(poolOf(0.012, 0.008, 0.1));
  step(*world, 30);
  AddWound line;
  line.wound.name = std::string{"cut"};
  line.wound.position = {0.02, 0.01, 0.0};
  line.wound.shape = PolylinePatch{{{0.0, 0.0}, {0.004, 0.0}, {0.006, 0.002}}, 0.002};
  line.wound.drive = PressureDriveSettings{200.0, 0.6};
  ASSERT_TRUE(world->apply(line).ok());
  AddWound other;
  other.wound.position = {-0.02, 0.0, 0.0};
  other.wound.shape = EllipsePatch{0.003, 0.002};
  other.wound.drive = FlowDrive{1e-6};
  ASSERT_TRUE(world->apply(other).ok());
  step(*world, 30);
  UpdateWound moved;
  moved.wound_id = 1;
  moved.position = Vec3{0.001, 0.0, 0.0};
  moved.name = "vessel";
  ASSERT_TRUE(world->apply(moved).ok());
  ASSERT_TRUE(world->apply(RemoveWound{3}).ok());
  step(*world, 7);  // the throat of the moved wound has turns of its own
  const auto heir = test::makeWorld(world->description());
  ASSERT_TRUE(heir->restoreState(saved(*world)).ok());
  EXPECT_EQ(heir->woundName(1), "vessel");
  EXPECT_EQ(heir->woundName(2), "cut");
  EXPECT_EQ(heir->woundName(3), "");
  expectGoesOn(*world, {});
  ASSERT_TRUE(heir->restoreState(saved(*world)).ok());
  for (World* each : {world.get(), heir.get()}) {
    const Result<Applied> added = each->apply(AddWound{other.wound});
    ASSERT_TRUE(added.ok()) << added.status().message();
    EXPECT_EQ(added->object_id, 4u) << "an id was given twice";
    ASSERT_TRUE(each->apply(RemoveWound{1}).ok());
  }
  expectSameSteps(*world, *heir, 20);
}

TEST(WorldState, AtCapacityWithHolesInAThroat) {
  WorldDescription scene = test::woundOnPlane(0.003, 3e-6);
  scene.capacity = 120;
  const auto world = test::makeWorld(scene);
  for (int k = 0; k < 4000 && test::counterOf(*world, Counter::emission_refused) == 0; ++k) step(*world, 1);
  ASSERT_GT(test::counterOf(*world, Counter::emission_refused), 0u);
  expectGoesOn(*world, {}, 100);
}

TEST(WorldState, SavingAllocatesNothing) {
  const auto world = test::makeWorld(pool(255));
  stir(*world);
  step(*world, 5);
  Bytes room(world->stateBytes());
  const std::uint64_t before = test::allocationCount();
  const std::size_t bytes = world->stateBytes();
  const std::size_t written = world->saveState(room);
  EXPECT_EQ(test::allocationCount(), before);
  EXPECT_EQ(written, room.size());
  EXPECT_EQ(bytes, room.size());
}

TEST(WorldState, NeedsItsRoom) {
  const auto world = test::makeWorld(pool(0));
  Bytes room(world->stateBytes() - 1);
  EXPECT_EQ(world->saveState(room), 0u);
}

class Refusals : public testing::Test {
 protected:
  Refusals() {
    world_ = test::makeWorld(pool(2 | 4));
    stir(*world_);
    step(*world_, 30);
    state_ = saved(*world_);
  }

  std::string refusal(const Bytes& state, World& world) {
    const std::uint64_t before = world.stateHash();
    const Status status = world.restoreState(state);
    EXPECT_FALSE(status.ok());
    EXPECT_EQ(world.stateHash(), before) << "a refusal changed the world";
    return status.message();
  }
  std::string refusal(const Bytes& state) { return refusal(state, *world_); }

  template <class T>
  Bytes with(std::size_t at, T value) const {
    Bytes changed = state_;
    std::memcpy(changed.data() + at, &value, sizeof value);
    return changed;
  }
  /// Where the scalars end and the particles' positions begin.
  std::size_t arrays() const { return (23 + static_cast<std::size_t>(Counter::count)) * 8; }
  std::size_t count() const {
    std::uint64_t count = 0;
    std::memcpy(&count, state_.data() + 4 * 8, sizeof count);
    return count;
  }

  std::unique_ptr<World> world_;
  Bytes state_;
};

TEST_F(Refusals, TellWhatIsWrong) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::size_t n = count() * sizeof(float);
  const std::size_t ids = arrays() + 9 * n;  // after 6, 1/mu, P and the radius
  const std::vector<std::pair<Bytes, std::string>> table{
      {Bytes{}, "ends before its particles"},
      {Bytes(state_.begin(), state_.begin() + 1000), "ends within its particles"},
      {Bytes(state_.begin(), state_.end() - 1), "force sources"},
      {with(0, std::uint64_t{7}), "no state of a world"},
      {with(8, std::uint64_t{8}), "another precision"},
      {with(16, std::uint64_t{8}), "another scene"},
      {with(24, 7.0), "another speed of sound"},
      {with(32, std::uint64_t{1} << 40), "more than the capacity"},
      {with(40, std::uint64_t{1} << 40), "numbers of particles"},
      {with(40, std::uint64_t{0}), "behind the wounds' patches"},
      {with(48, std::uint64_t{0}), "numbers of particles"},
      {with(48, std::uint64_t{3}), "id was never given"},
      {with(80, -1.0), "time is not a time"},
      {with(96, 0.0), "time is not a time"},
      {with(104, std::numeric_limits<double>::infinity()), "limit of the time step"},
      {with(144, 100.0), "reach of the neighbour search"},
      {with(152, std::uint64_t{2}), "no implicit viscosity"},
      {with(168, std::uint64_t{1} << 40), "clotting is due too late"},
      {with(176, -1.0), "time is not a time"},
      {with(arrays(), kNan), "position is not finite"},
      {with(arrays() + n - 4, 1e6F), "outside the domain"},  // the last particle, which no wound drives
      {with(arrays() + 3 * n, 1e4F), "velocity"},
      {with(arrays() + 6 * n, -1.0F), "viscosity"},
      {with(arrays() + 7 * n, kNan), "blood is not finite"},
      {with(arrays() + 8 * n, 9.0F), "support radius"},
      {with(ids, std::uint32_t{0}), "id was never given"},
      {with(ids + 2 * n, kNan), "density or an acceleration"},
  };
  for (const auto& [bytes, message] : table) EXPECT_THAT(refusal(bytes), HasSubstr(message));
  Bytes twice = state_;
  std::memcpy(twice.data() + ids, twice.data() + ids + 4, 4);
  EXPECT_THAT(refusal(twice), HasSubstr("two particles have one id"));
  Bytes longer = state_;
  longer.push_back(std::byte{0});
  EXPECT_THAT(refusal(longer), HasSubstr("goes on after its end"));
}

TEST_F(Refusals, OfAnotherWorldsState) {
  const auto without = test::makeWorld(pool(2));
  EXPECT_THAT(refusal(state_, *without), HasSubstr("another scene"));
  const auto doubles = test::makeWorld(pool(2 | 4), {.precision = Precision::float64});
  EXPECT_THAT(refusal(state_, *doubles), HasSubstr("another precision"));
}

// Bytes that a checksum would have caught: whatever they are, the world either refuses them or can be stepped.
TEST_F(Refusals, AnyByteMayBeWrong) {
  std::mt19937 random{20261126};
  const auto heir = test::makeWorld(world_->description());
  int taken = 0;
  for (int k = 0; k < 1500; ++k) {
    Bytes changed = state_;
    const std::size_t at = random() % changed.size();
    changed[at] ^= static_cast<std::byte>(1u << random() % 8);
    if (!heir->restoreState(changed).ok()) continue;
    ++taken;
    if (k % 10 == 0) static_cast<void>(heir->step(1.0));
  }
  EXPECT_GT(taken, 0);
}

TEST(DescriptionHash, TellsEveryFieldApart) {
  const WorldDescription base = pool(255);
  std::map<std::uint64_t, int> seen;
  ++seen[descriptionHash(base)];
  const auto changed = [&](const std::function<void(WorldDescription&)>& edit) {
    WorldDescription other = base;
    edit(other);
    ++seen[descriptionHash(other)];
  };
  changed([](WorldDescription& d) { d.seed = 9; });
  changed([](WorldDescription& d) { d.spacing *= 1.0000001; });
  changed([](WorldDescription& d) { d.domain.upper.y() += 1e-9; });
  changed([](WorldDescription& d) { d.domain.periodic[2] = true; });
  changed([](WorldDescription& d) { d.effects.platelets.reset(); });
  changed([](WorldDescription& d) { d.effects.viscosity->rheology = CassonRheology{}; });
  changed([](WorldDescription& d) { d.effects.surface_tension->contact_angle = 0.0; });
  changed([](WorldDescription& d) { d.tissue.front().slip = 0.5; });
  changed([](WorldDescription& d) { d.wounds.front().name = std::string{"a"}; });
  changed([](WorldDescription& d) { d.wounds.front().shape = EllipsePatch{0.003, 0.003}; });
  changed([](WorldDescription& d) { d.fluid_blocks.front().platelet = 0.5; });
  changed([](WorldDescription& d) { d.max_dt = 1.0; });
  EXPECT_EQ(seen.size(), 13u);
  EXPECT_EQ(descriptionHash(base), descriptionHash(pool(255)));
}

}  // namespace
}  // namespace bleedsim::sph
