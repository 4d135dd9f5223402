// Inviscid blood keeps its energy: the pressure term is the gradient of the density (16)(20) and of the wall's share, the spring
// that of a potential, and kick-drift-kick is time-reversible. physics.md section 5 case 3, walls.md "closed box".
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

constexpr int kAcross = 12;
constexpr double kSide = kAcross * kSpacing;
constexpr double kSpeed = 0.5;  // m/s, the scene's design speed

/// A swirl in the x-z plane that has no flow through the faces of the box, one half turn across it (`turns` 1) or whole (2).
sph::WorldDescription swirl(sph::WorldDescription scene, double support_ratio, double turns) {
  scene.support_ratio = support_ratio;
  scene.effects.viscosity.reset();
  setFlow(scene, 1, [&](const sph::Vec3& at) {
    const double x = turns * std::numbers::pi * at.x() / kSide;
    const double z = turns * std::numbers::pi * at.z() / kSide;
    return sph::Vec3{kSpeed * std::sin(x) * std::cos(z), 0.0, -kSpeed * std::cos(x) * std::sin(z)};
  });
  return scene;
}

/// Energy at t = 200 dx/c0 over that at the start.
double energyKept(const sph::WorldDescription& scene) {
  const auto world = makeWorld(scene);
  const double before = energyOf(*world);
  runFor(*world, 200.0 * kSpacing / world->speedOfSound());
  expectInvariants(*world);
  EXPECT_EQ(counterOf(*world, sph::Counter::speed_clamped), 0u);
  EXPECT_EQ(counterOf(*world, sph::Counter::acceleration_clamped), 0u);
  return energyOf(*world) / before;
}

class EnergyTest : public testing::TestWithParam<double> {};

// walls.md measured 1.004 / 1.002 with this wall model; the rest is the time step's share.
TEST_P(EnergyTest, closedBoxKeepsOnePercent) {
  const double kept = energyKept(swirl(closedBox({kAcross, kAcross, kAcross}, 0.05), GetParam(), 1.0));
  RecordProperty("energy_ratio", std::to_string(kept));
  EXPECT_NEAR(kept, 1.0, 0.01);
}

// No wall: what remains is the time step's second order, which the half step shows (measured 0.9989 / 0.9994 at the stable step,
// 0.9997 / 0.9998 at half of it, the same in double). The thousandth of physics.md holds for its standard preset, h = 2.5 dx, at
// the stable step; h = 2 dx is the draft preset and gets twice that.
TEST_P(EnergyTest, periodicBoxKeepsAThousandth) {
  sph::WorldDescription scene = swirl(periodicBox({kAcross, kAcross, kAcross}, 0.05), GetParam(), 2.0);
  const double kept = energyKept(scene);
  RecordProperty("energy_ratio", std::to_string(kept));
  EXPECT_NEAR(kept, 1.0, GetParam() < 2.5 ? 0.002 : 0.001);
  scene.max_dt = 0.2 * kSpacing / (sph::speedOfSound(scene) + kSpeed);
  EXPECT_NEAR(energyKept(scene), 1.0, 0.0005);
}

// (34) that followed every ripple would end at 49 times the energy (core_radius.h); without (34) this box ends at 0.999. Measured
// 0.9995 to 1.0003: the bound is that of the box without the effect.
TEST_P(EnergyTest, coreRadiusKeepsWhatABoxWithoutItKeeps) {
  sph::WorldDescription periodic = swirl(periodicBox({kAcross, kAcross, kAcross}, 0.05), GetParam(), 2.0);
  periodic.effects.core_radius.emplace();
  const double in_periodic = energyKept(periodic);
  RecordProperty("periodic_energy_ratio", std::to_string(in_periodic));
  EXPECT_NEAR(in_periodic, 1.0, 0.002);
  sph::WorldDescription closed = swirl(closedBox({kAcross, kAcross, kAcross}, 0.05), GetParam(), 1.0);
  closed.effects.core_radius.emplace();
  const double in_closed = energyKept(closed);
  RecordProperty("closed_energy_ratio", std::to_string(in_closed));
  EXPECT_NEAR(in_closed, 1.0, 0.01);
}

// Viscosity only takes: a viscous box never gains, sampled every 20 steps, to the inviscid drift of a step.
TEST_P(EnergyTest, viscosityOnlyTakes) {
  sph::WorldDescription scene = swirl(periodicBox({kAcross, kAcross, kAcross}, 0.05), GetParam(), 2.0);
  scene.effects.viscosity.emplace().viscosity = 0.01;
  const auto world = makeWorld(scene);
  const double before = energyOf(*world);
  double last = before;
  std::uint64_t checked = 0;
  runFor(*world, 100.0 * kSpacing / world->speedOfSound(), [&] {
    if (world->stepCount() % 20 != 0) return;
    const double now = energyOf(*world);
    EXPECT_LT(now, last + 1e-3 * before);
    last = now;
    ++checked;
  });
  EXPECT_GT(checked, 5u);
  EXPECT_LT(last, 0.9 * before);
}

INSTANTIATE_TEST_SUITE_P(supportRatios, EnergyTest, testing::Values(2.0, 2.5),
                         [](const auto& tested) { return tested.param == 2.0 ? "two" : "twoAndAHalf"; });

}  // namespace
}  // namespace bleedsim::test
