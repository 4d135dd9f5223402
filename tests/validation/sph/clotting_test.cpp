// Platelets where there is no closed form, and a clot that holds where blood runs. The forms of physics.md section 5 case 12 are
// the cases platelet_spread and platelet_activation (cases_test.cpp).
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

// The exchange of a pair is equal and opposite, where particles move and stand in disorder as well.
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
