// A free drop under surface tension: Laplace's pressure and Rayleigh's period. physics.md section 5 case 9. sigma 0.055 N/m, rho
// 1060 kg/m^3, dx 1 mm.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "tests/stability/sph/measure.h"
#include "tests/support/drops.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

constexpr double kSigma = 0.055;  // N/m

/// A lattice ball about the origin.
sph::WorldDescription drop(double support_ratio, double radius_in_spacings, double viscosity) {
  sph::WorldDescription scene = emptyScene();
  scene.support_ratio = support_ratio;
  scene.domain.lower = Vec3::Constant(-0.03);
  scene.domain.upper = Vec3::Constant(0.03);
  scene.compressibility.design_speed = 0.2;
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.viscosity->viscosity = viscosity;
  scene.effects.surface_tension.emplace();
  scene.effects.surface_tension->coefficient = kSigma;
  addBall(scene, Vec3::Zero(), radius_in_spacings * scene.spacing);
  return scene;
}

/// Of the ball that holds the particles' volume, m.
double radiusOf(const sph::World& world) {
  return std::cbrt(3.0 * world.particleCount() * world.description().particleVolume() / (4.0 * std::numbers::pi));
}

/// The drop of R = 8 dx, come to rest at 0.5 Pa s.
std::unique_ptr<sph::World> restingDrop(double support_ratio) {
  auto world = makeWorld(drop(support_ratio, 8.0, 0.5));
  runFor(*world, 0.1);
  return world;
}

/// Mean pressure of the inner half of the radius, Pa.
double corePressure(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  const Vec3 center = statsOf(world).center;
  const double c2 = world.speedOfSound() * world.speedOfSound();
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    if ((positionOf(frame, i) - center).norm() > 0.5 * radiusOf(world)) continue;
    sum += std::max(0.0, c2 * (static_cast<double>(frame.density[i]) - kRestDensity));
    ++count;
  }
  return sum / count;
}

struct Accuracy {
  const char* name;
  double support_ratio;
  double laplace;  ///< relative
  double period;   ///< relative
};

class DropTest : public testing::TestWithParam<Accuracy> {};

// p = 2 sigma/R, R of the drop's volume: the pressure in the middle is what balances tension along a radius, and it is the mean
// over 0.2 s that does, because a drop rings at the speed of sound.
TEST_P(DropTest, laplacePressure) {
  sph::WorldDescription scene = restarted(*restingDrop(GetParam().support_ratio));
  scene.effects.viscosity->viscosity = 0.05;
  const auto world = makeWorld(scene);
  runFor(*world, 0.1);
  double sum = 0.0;
  int count = 0;
  runFor(*world, 0.2, [&] {
    if (world->stepCount() % 5 != 0) return;
    sum += corePressure(*world);
    ++count;
  });
  const double ratio = sum / count / (2.0 * kSigma / radiusOf(*world));
  RecordProperty("pressure_ratio", std::to_string(ratio));
  EXPECT_NEAR(ratio, 1.0, GetParam().laplace);
}

/// Mean of z^2 - (x^2 + y^2)/2, m^2: 0 for a ball.
double prolateness(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  const Vec3 center = statsOf(world).center;
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const Vec3 r = positionOf(frame, i) - center;
    sum += r.z() * r.z() - 0.5 * (r.x() * r.x() + r.y() * r.y());
  }
  return sum / frame.count;
}

// omega^2 = 8 sigma/(rho R^3) (Rayleigh 1879), with rho R^3 from the drop's mass. The drop at rest gets the
// velocity of the mode, 0.1 omega (-x/2, -y/2, z), and swings at blood's viscosity. The period is that of the zero crossings, two
// of them to a period.
TEST_P(DropTest, rayleighPeriod) {
  const auto resting = restingDrop(GetParam().support_ratio);
  const double radius = radiusOf(*resting);
  const double omega = std::sqrt(8.0 * kSigma / (kRestDensity * radius * radius * radius));
  const double expected = 2.0 * std::numbers::pi / omega;
  sph::WorldDescription scene = restarted(*resting, [&](const Vec3& x) -> Vec3 {
    return 0.1 * omega * Vec3{-0.5 * x.x(), -0.5 * x.y(), x.z()};
  });
  scene.effects.viscosity->viscosity = 0.00345;
  const auto world = makeWorld(scene);
  std::vector<double> crossings;
  double before = 0.0;
  double time_before = 0.0;
  runFor(*world, 2.2 * expected, [&] {
    if (world->stepCount() % 4 != 0) return;
    const double now = prolateness(*world);
    if (before * now < 0.0) crossings.push_back(time_before + (world->time() - time_before) * before / (before - now));
    before = now;
    time_before = world->time();
  });
  ASSERT_GE(crossings.size(), 3u);
  const std::size_t last =
      (crossings.size() - 1) / 2 * 2;  // whole periods: a drop that rests a little out of round does not matter
  const double period = 2.0 * (crossings[last] - crossings[0]) / static_cast<double>(last);
  RecordProperty("period_ratio", std::to_string(period / expected));
  EXPECT_NEAR(period / expected, 1.0, GetParam().period);
  expectInvariants(*world);
  const Vec3 momentum = momentumOf(*world);
  EXPECT_LT(momentum.norm(), 1e-5 * world->particleMass() * world->particleCount() * speedRms(*world));
}

INSTANTIATE_TEST_SUITE_P(supportRatios, DropTest,
                         testing::Values(Accuracy{"twoAndAHalf", 2.5, 0.30, 0.30}, Accuracy{"three", 3.0, 0.05, 0.12}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::test
