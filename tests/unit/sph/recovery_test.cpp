// The recovery ladder: what starts it, each rung, and that a step which was taken back leaves nothing behind.
#include "service/sph/recovery.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "service/sph/world_core.h"
#include "service/sph/world_setup.h"
#include "tests/support/compiled_tables.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kAnyStep = std::numeric_limits<double>::infinity();

/// What the next force passes, or the implicit solve's next products, give beside what they compute.
template <class Real>
struct Poison {
  ForceFunction<Real> force = nullptr;                       // the pass itself
  SweepFunction<ViscousProductJob<Real>> product = nullptr;  // the sweep itself
  int passes = 0;                                            // left
  std::uint32_t first = 0, last = 0;                         // particles in storage order, last excluded
  Real value = 0;                                            // of the x component
};
template <class Real>
Poison<Real> poison;

/// Of a pass, whose particles may come in several calls, from the first on.
template <class Real>
void addPoison(const SweepJob<Real>& job, Real* vectors) {
  Poison<Real>& active = poison<Real>;
  const std::uint32_t begin = job.grid.rowBegin(job.row_begin);
  const std::uint32_t end = job.grid.rowBegin(job.row_end);
  if (active.passes <= 0) return;
  for (std::uint32_t i = std::max(begin, active.first); i < std::min(end, active.last); ++i) {
    vectors[std::size_t{i} * 4] = active.value;
  }
  if (begin < active.last && active.last <= end) --active.passes;
}

template <class Real>
void poisonedForce(const ForceJob<Real>& job) {
  poison<Real>.force(job);
  addPoison(job, job.acceleration);
}

template <class Real>
void poisonedProduct(const ViscousProductJob<Real>& job) {
  poison<Real>.product(job);
  addPoison(job, job.product);
}

/// A world whose passes can be poisoned; all particles are on one thread.
template <class Real>
class PoisonedWorld {
 public:
  explicit PoisonedWorld(const WorldDescription& description) : passes_{test::passesOf<Real>(description, target())} {
    sweeps_ = test::sweepsOf<Real>(sweepChoice(description), target());
    poison<Real> = {};
    const std::size_t set = pairSet(description).index();
    poison<Real>.force = passes_.force[set];
    poison<Real>.product = sweeps_.uniform_viscous_product;
    passes_.force[set] = poisonedForce<Real>;
    sweeps_.uniform_viscous_product = poisonedProduct<Real>;
    const RestLattice lattice = calibrateRestLattice(description.densityKernel(), description.spacing, description.rest_density);
    auto tissue = TissueField<Real>::create(description.tissue, {.kernel = description.densityKernel(),
                                                                 .spacing = description.spacing,
                                                                 .particle_mass = lattice.particle_mass,
                                                                 .rest_density = description.rest_density,
                                                                 .radii = radiusBounds(description),
                                                                 .calibrates_radii = true});
    world_ = std::make_unique<WorldCore<Real>>(description, WorldOptions{}, target(), WorldTables<Real>{passes_, sweeps_},
                                               lattice, std::move(*tissue));
    if (const Status status = world_->populate(); !status.ok()) throw std::runtime_error{status.message()};
  }
  World* operator->() { return world_.get(); }
  World& operator*() { return *world_; }

 private:
  static SimdTarget target() { return availableSimdTargets().front(); }

  PassTable<Real> passes_;
  SweepTable<Real> sweeps_;
  std::unique_ptr<WorldCore<Real>> world_;
};

template <class Real>
void poisonPasses(int passes, std::uint32_t first, std::uint32_t last, Real value) {
  poison<Real>.passes = passes;
  poison<Real>.first = first;
  poison<Real>.last = last;
  poison<Real>.value = value;
}

template <class Real>
class Recovery : public testing::Test {
 protected:
  static constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
  static constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Recovery, Reals);

/// A wound that bleeds into a full world, over a block of blood.
WorldDescription bleeding() {
  WorldDescription scene = test::woundOnPlane(0.002, 3e-6);
  FluidBlock block;
  block.lower = {0.01, 0.01, 0.0};
  block.upper = {0.016, 0.016, 0.006};
  block.velocity = {0.1, 0.05, 0.0};
  scene.fluid_blocks.push_back(block);
  scene.capacity = 300;
  scene.effects.applied_force.emplace();
  return scene;
}

// The step that is tried again with a quarter of the time is, to the bit, the step that was asked for with a quarter of the time:
// emission, refusals at capacity, ledgers and all. The next one goes on from there.
TYPED_TEST(Recovery, halvesUntilForcesAreFinite) {
  PoisonedWorld<TypeParam> plain{bleeding()};
  PoisonedWorld<TypeParam> hurt{bleeding()};
  for (int step = 0; step < 400; ++step) {
    ASSERT_TRUE(plain->step(kAnyStep).ok());
    ASSERT_TRUE(hurt->step(kAnyStep).ok());
  }
  ASSERT_GT(test::counterOf(*plain, Counter::emission_refused), 0u) << "the world must be full";
  double quarter = 0.0;
  for (int turn = 0; turn < 20; ++turn) {
    poisonPasses<TypeParam>(2, 17, 18, this->kNan);
    ASSERT_TRUE(hurt->step(kAnyStep).ok());
    quarter = test::statsOf(*hurt).dt;
    ASSERT_TRUE(plain->step(quarter).ok());
    ASSERT_EQ(hurt->stateHash(), plain->stateHash()) << turn;
  }
  const WorldStats stats = test::statsOf(*hurt);
  EXPECT_LT(quarter, 0.1 * 0.4 * test::kSpacing / hurt->speedOfSound()) << "it grows by a tenth only after each";
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(Counter::step_retried)], 40u);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(Counter::particle_frozen)], 0u);
  WorldStats same = test::statsOf(*plain);
  same.counters[static_cast<std::size_t>(Counter::step_retried)] = 40;
  EXPECT_EQ(stats.counters, same.counters);
  EXPECT_EQ(stats.emitted_volume, same.emitted_volume);
  EXPECT_EQ(stats.commanded_volume, same.commanded_volume);
  EXPECT_EQ(stats.injected, same.injected);
  EXPECT_EQ(stats.removed, same.removed);
}

TYPED_TEST(Recovery, freezesTheOffenderAlone) {
  PoisonedWorld<TypeParam> world{test::freeBlock({6, 6, 6})};
  ASSERT_TRUE(world->step(kAnyStep).ok());
  poisonPasses<TypeParam>(6, 40, 41, this->kNan);
  ASSERT_TRUE(world->step(kAnyStep).ok());
  EXPECT_FALSE(world->faulted());
  EXPECT_EQ(test::counterOf(*world, Counter::step_retried), 4u);
  EXPECT_EQ(test::counterOf(*world, Counter::particle_frozen), 1u);
  EXPECT_EQ(test::counterOf(*world, Counter::infinite_force_capped), 0u);
  EXPECT_EQ(world->particleCount(), 216u);
  const FrameBuffer frame = test::frameOf(*world);
  for (std::size_t i = 0; i < frame.count; ++i) {
    EXPECT_TRUE(test::positionOf(frame, i).allFinite() && test::velocityOf(frame, i).allFinite());
  }
  ASSERT_TRUE(world->step(kAnyStep).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::step_retried), 4u);
}

// An infinite force has a direction, so it is capped: v = a_cap dt/2 along it after a step of dt from rest.
TYPED_TEST(Recovery, capsAnInfiniteForce) {
  PoisonedWorld<TypeParam> world{test::freeBlock({6, 6, 6})};
  poisonPasses<TypeParam>(6, 40, 41, -this->kInfinity);
  ASSERT_TRUE(world->step(kAnyStep).ok());
  const WorldStats stats = test::statsOf(*world);
  EXPECT_EQ(test::counterOf(*world, Counter::particle_frozen), 0u);
  EXPECT_EQ(test::counterOf(*world, Counter::infinite_force_capped), 1u);
  EXPECT_EQ(test::counterOf(*world, Counter::acceleration_clamped), 0u) << "a rung is counted apart";
  const double cap = kAccelerationBound * world->speedOfSound() * world->speedOfSound() / test::kSpacing;
  const double expected = -world->particleMass() * 0.5 * cap * stats.dt;
  EXPECT_NEAR(stats.momentum.x() / expected, 1.0, 1e-4);
}

// A finite force beyond its bound is cut in every attempt, which is no rung of the ladder.
TYPED_TEST(Recovery, clampsAFiniteForceWithoutTheLadder) {
  PoisonedWorld<TypeParam> world{test::freeBlock({6, 6, 6})};
  const double cap = kAccelerationBound * world->speedOfSound() * world->speedOfSound() / test::kSpacing;
  poisonPasses<TypeParam>(6, 40, 43, static_cast<TypeParam>(3.0 * cap));
  ASSERT_TRUE(world->step(kAnyStep).ok());
  EXPECT_EQ(test::counterOf(*world, Counter::acceleration_clamped), 3u);
  EXPECT_EQ(test::counterOf(*world, Counter::infinite_force_capped), 0u);
  EXPECT_EQ(test::counterOf(*world, Counter::particle_frozen), 0u);
}

// Nothing left that moves: the world is faulted and shows the state before the step, its counters included.
TYPED_TEST(Recovery, faultsWhenNothingIsFinite) {
  PoisonedWorld<TypeParam> world{bleeding()};
  for (int step = 0; step < 30; ++step) ASSERT_TRUE(world->step(kAnyStep).ok());
  const std::uint64_t before = world->stateHash();
  const WorldStats earlier = test::statsOf(*world);
  poisonPasses<TypeParam>(1000, 0, earlier.particles, this->kNan);
  const Status status = world->step(kAnyStep);
  EXPECT_EQ(status.code(), StatusCode::internal);
  EXPECT_TRUE(world->faulted());
  EXPECT_EQ(world->stateHash(), before);
  const WorldStats stats = test::statsOf(*world);
  EXPECT_EQ(stats.injected, earlier.injected);
  EXPECT_EQ(stats.emitted_volume, earlier.emitted_volume);
  EXPECT_EQ(stats.counters[static_cast<std::size_t>(Counter::step_retried)], 4u);
  const FrameBuffer frame = test::frameOf(*world);
  for (std::size_t i = 0; i < frame.count; ++i) {
    EXPECT_TRUE(test::velocityOf(frame, i).allFinite());
    EXPECT_TRUE(std::isfinite(frame.density[i]));
  }
  EXPECT_EQ(world->step(kAnyStep).code(), StatusCode::internal);
}

// A solve that gives no numbers: the last attempt goes without it.
TYPED_TEST(Recovery, leavesAnImplicitSolveOut) {
  WorldDescription scene = test::freeBlock({6, 6, 6}, 0.1);
  scene.effects.viscosity->viscosity = 10.0;
  scene.effects.viscosity->solve = ViscositySolve::implicit;
  PoisonedWorld<TypeParam> solved{scene};
  poisonPasses<TypeParam>(1000, 40, 41, this->kNan);
  ASSERT_TRUE(solved->step(kAnyStep).ok());
  EXPECT_EQ(test::counterOf(*solved, Counter::step_retried), 4u);
  EXPECT_EQ(test::counterOf(*solved, Counter::viscosity_unsolved), 1u);
  const FrameBuffer frame = test::frameOf(*solved);
  for (std::size_t i = 0; i < frame.count; ++i) EXPECT_TRUE(test::velocityOf(frame, i).allFinite());
}

/// Enough blood for a second thread, in a box, that takes forces.
WorldDescription pool() {
  WorldDescription scene = test::hydrostaticColumn({16, 16, 10}, 0.00345);
  scene.effects.applied_force.emplace();
  return scene;
}

SetForce blow() {
  SetForce force;
  force.key = 1;
  force.position = {0.008, 0.008, 0.008};
  force.radius = 0.003;
  force.force = {0.0, 0.0, -10.0};
  return force;
}

// A blow that comes between two steps overruns the one that was chosen in peace; healthy steps are never tried again.
TEST(RecoveryOfAWorld, halvesAStepThatIsOverrun) {
  const auto one = test::makeWorld(pool(), {.threads = 1});
  const auto two = test::makeWorld(pool(), {.threads = 2});
  ASSERT_GT(one->particleCount(), 2000u) << "fewer run on one thread";
  for (int step = 0; step < 60; ++step) {
    ASSERT_TRUE(one->step(kAnyStep).ok());
    ASSERT_TRUE(two->step(kAnyStep).ok());
  }
  EXPECT_EQ(test::counterOf(*one, Counter::step_retried), 0u);
  const double peace = test::statsOf(*one).dt;
  for (World* world : {one.get(), two.get()}) ASSERT_TRUE(world->apply(blow()).ok());
  for (int step = 0; step < 20; ++step) {
    ASSERT_TRUE(one->step(kAnyStep).ok());
    ASSERT_TRUE(two->step(kAnyStep).ok());
    if (step == 0) { EXPECT_LT(test::statsOf(*one).dt, 0.6 * peace); }
  }
  EXPECT_GE(test::counterOf(*one, Counter::step_retried), 1u);
  EXPECT_EQ(test::counterOf(*one, Counter::particle_frozen), 0u);
  EXPECT_EQ(one->stateHash(), two->stateHash());
  EXPECT_EQ(test::statsOf(*one).counters, test::statsOf(*two).counters);
}

TEST(Trouble, isNamedByWhatTheStepShows) {
  EXPECT_EQ(troubleOf(true, 1.0, 1.0), Trouble::none);
  EXPECT_EQ(troubleOf(true, 1.0, 0.5), Trouble::none);
  EXPECT_EQ(troubleOf(true, 1.0, 0.49), Trouble::too_long);
  EXPECT_EQ(troubleOf(false, 1.0, 1.0), Trouble::not_finite);
}

// Squares of speeds and accelerations overflow in float32 long before the numbers themselves do.
TEST(Bounds, keepTheDirectionOfWhatOverflows) {
  float x = 3e30F;
  float y = -4e30F;
  float z = 0.0F;
  scaleTo(10.0F, x * x + y * y, x, y, z);
  EXPECT_NEAR(x, 6.0F, 1e-5F);
  EXPECT_NEAR(y, -8.0F, 1e-5F);
  EXPECT_EQ(z, 0.0F);
}

}  // namespace
}  // namespace bleedsim::sph
