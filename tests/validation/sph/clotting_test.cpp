// Platelets against closed forms, physics.md section 5 case 12, and a clot that holds where blood runs.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

double sumOfPlatelets(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  double sum = 0.0;
  for (const float p : frame.platelet) sum += double(p);
  return sum;
}

/// Blood at rest with periodic sides, no viscosity, which at P = 0 would take tiny steps, and no sinks.
sph::WorldDescription still(const Counts& counts, double support_ratio, double diffusivity) {
  sph::WorldDescription scene = periodicBox(counts);
  scene.support_ratio = support_ratio;
  scene.compressibility.design_speed = 0.01;
  scene.effects.viscosity.reset();
  auto& platelets = scene.effects.platelets.emplace();
  platelets.diffusivity = diffusivity;
  platelets.activation_rate = 0.0;
  platelets.wall_rate = 0.0;
  platelets.air_rate = 0.0;
  return scene;
}

class DiffusionTest : public testing::TestWithParam<double> {};

// A step from 1 to 0 at x = 0: P = erfc(x/(2 sqrt(k t)))/2. sqrt(4 k t) = 5 dx, far from the other step at 20 dx. L2 of the rows
// <= 3 %. 0 <= P <= 1; the exchange of a pair is equal and opposite, so sum P stays to 1e-6.
TEST_P(DiffusionTest, aStepSpreadsLikeTheErrorFunction) {
  constexpr double kDiffusivity = 1e-6;
  constexpr int kLong = 40;
  sph::WorldDescription scene = still({kLong, 9, 9}, GetParam(), kDiffusivity);
  sph::FluidBlock fresh = scene.fluid_blocks[0];
  sph::FluidBlock empty = fresh;
  const double middle = 0.5 * kLong * kSpacing;
  fresh.upper.x() = middle;
  fresh.platelet = 1.0;
  empty.lower.x() = middle;
  empty.platelet = 0.0;
  scene.fluid_blocks = {fresh, empty};
  const auto world = makeWorld(scene);
  const double before = sumOfPlatelets(*world);
  const double reach = 5.0 * kSpacing;
  runFor(*world, reach * reach / (4.0 * kDiffusivity));
  const double spread = 2.0 * std::sqrt(kDiffusivity * world->time());
  const sph::FrameBuffer frame = frameOf(*world);
  double squares = 0.0;
  double reference = 0.0;
  for (int row = kLong / 4; row < 3 * kLong / 4; ++row) {
    const double found = layerMean(*world, frame, 0, 0.0, row, [&](std::size_t i) { return double(frame.platelet[i]); });
    const double exact = 0.5 * std::erfc(((row + 0.5) * kSpacing - middle) / spread);
    squares += (found - exact) * (found - exact);
    reference += exact * exact;
  }
  const double error = std::sqrt(squares / reference);
  RecordProperty("l2", std::to_string(error));
  RecordProperty("sum", std::to_string(sumOfPlatelets(*world) / before - 1.0));
  EXPECT_LT(error, 0.03);
  for (const float p : frame.platelet) {
    EXPECT_GE(p, 0.0f);
    EXPECT_LE(p, 1.0f);
  }
  EXPECT_NEAR(sumOfPlatelets(*world) / before, 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(supportRatios, DiffusionTest, testing::Values(2.0, 2.5),
                         [](const auto& tested) { return tested.param == 2.0 ? "two" : "twoAndAHalf"; });

// The same where particles move and stand in disorder.
TEST(Diffusion, KeepsTheSumInStirredBlood) {
  sph::WorldDescription scene = still({16, 8, 8}, 2.0, 1e-5);
  scene.fluid_blocks[0].jitter = 0.2;
  scene.effects.viscosity.emplace();
  scene.compressibility.design_speed = 0.2;
  sph::FluidBlock first = scene.fluid_blocks[0];
  sph::FluidBlock second = first;
  first.upper.x() = 8 * kSpacing;
  first.velocity = {0.0, 0.2, 0.0};
  second.lower.x() = 8 * kSpacing;
  second.platelet = 0.3;
  scene.fluid_blocks = {first, second};
  const auto world = makeWorld(scene);
  const double before = sumOfPlatelets(*world);
  runFor(*world, 0.03);
  EXPECT_NEAR(sumOfPlatelets(*world) / before, 1.0, 1e-6);
  const sph::FrameBuffer frame = frameOf(*world);
  int mixed = 0;
  for (const float p : frame.platelet) mixed += p > 0.4f && p < 0.9f ? 1 : 0;
  EXPECT_GT(mixed, 100) << "nothing was exchanged";
}

// dP/dt = -r P (1 - P) from 0.99: logit P = ln 99 - r t, so P = 1/2 at t50 = ln 99/r, 2 %; `clot_speedup` multiplies r.
TEST(Activation, HalfTimeIsTheLogisticOne) {
  for (const double speedup : {1.0, 10.0}) {
    sph::WorldDescription scene = still({8, 8, 8}, 2.0, 1e-9);
    scene.effects.platelets->activation_rate = 40.0;
    scene.effects.platelets->clot_speedup = speedup;
    const auto world = makeWorld(scene);
    double platelet = 1.0;
    double before = 1.0;
    while (platelet > 0.5) {
      before = platelet;
      ASSERT_TRUE(world->step(1e-4 / speedup).ok());
      platelet = sumOfPlatelets(*world) / world->particleCount();
    }
    const double last = statsOf(*world).dt;
    const double found = world->time() - last * (0.5 - platelet) / (before - platelet);
    const double expected = std::log(99.0) / (40.0 * speedup);
    RecordProperty("t50_ratio_" + std::to_string(speedup), std::to_string(found / expected));
    EXPECT_NEAR(found / expected, 1.0, 0.02);
  }
}

// A pool of 18 x 12 x 4 mm on a slope of 30 degrees for 0.1 s. Its clotting is sped up so that half of the platelets have gone
// after 3 ms: it becomes a clot of 10 Pa s, which creeps with rho g sin(30) H^2/(2 b) = 4 mm/s at most, 0.4 mm. Fresh blood
// of 3.5 mPa s is held by a thin layer at the wall only and slides by nearly g sin(30) t^2/2 = 25 mm. 24 and 0.3 mm were
// measured.
TEST(Clot, HoldsOnASlopeWhereBloodRuns) {
  const auto travel = [](double speedup) {
    sph::WorldDescription scene = emptyScene();
    scene.spacing = 0.002;
    scene.domain.lower = {-0.03, -0.03, -0.01};
    scene.domain.upper = {0.12, 0.03, 0.03};
    const double angle = std::numbers::pi / 6.0;
    scene.effects.pressure.emplace();
    scene.effects.viscosity.emplace();
    scene.effects.gravity.emplace().acceleration = kGravity * sph::Vec3{std::sin(angle), 0, -std::cos(angle)};
    scene.effects.platelets.emplace().clot_speedup = speedup;
    scene.tissue.push_back({.name = "slope", .shape = sph::PlaneShape{}});
    addBlock(scene, {-0.009, -0.006, 0}, {9, 6, 2});
    const auto world = makeWorld(scene);
    const double start = statsOf(*world).center.x();
    runFor(*world, 0.1);
    expectInvariants(*world);
    return statsOf(*world).center.x() - start;
  };
  const double fresh = travel(1.0);
  const double clotted = travel(std::log(99.0) / (0.0153 * 0.003));
  RecordProperty("fresh", std::to_string(fresh));
  RecordProperty("clotted", std::to_string(clotted));
  EXPECT_GT(fresh, 0.01);
  EXPECT_LT(clotted, 0.05 * fresh);
}

}  // namespace
}  // namespace bleedsim::test
