// A free drop under surface tension: Laplace's pressure and Rayleigh's period. physics.md section 5 case 9. sigma 0.055 N/m, rho
// 1060 kg/m^3, dx 1 mm.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "tests/stability/sph/measure.h"
#include "tests/support/drops.h"
#include "tests/support/tension_rig.h"

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

/// A drop that comes to rest at 0.5 Pa s.
std::unique_ptr<sph::World> restingDrop(double support_ratio, double radius_in_spacings = 8.0, double seconds = 0.1) {
  auto world = makeWorld(drop(support_ratio, radius_in_spacings, 0.5));
  runFor(*world, seconds);
  return world;
}

/// What the accelerations by tension alone say of the pressure, over 2 sigma/R. The velocities, which tension damps, are left
/// out.
struct RadialBalance {
  double along = 0.0;    ///< p(0) = -int rho a . rhat dr: each particle's m over the area 4 pi r^2 at which it stands
  double surface = 0.0;  ///< all of it on the surface: -sum m a . rhat/(4 pi R^2)
};
RadialBalance radialBalance(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  const Vec3 center = statsOf(world).center;
  OracleParticles particles;
  for (std::size_t i = 0; i < frame.count; ++i) particles.position.push_back(positionOf(frame, i) - center);
  particles.velocity.assign(frame.count, Vec3::Zero());
  const sph::TensionRig<float> rig{world.description(), sph::availableSimdTargets().front(), particles};
  const double radius = radiusOf(world);
  const double unit = world.particleMass() / (4.0 * std::numbers::pi) / (2.0 * kSigma / radius);
  RadialBalance balance;
  for (std::size_t i = 0; i < frame.count; ++i) {
    const double r = particles.position[i].norm();
    const double inward = -rig.acceleration()[i].dot(particles.position[i]) / r;
    balance.along += unit * inward / (r * r);
    balance.surface += unit * inward / (radius * radius);
  }
  return balance;
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

struct Ball {
  const char* name;
  double support_ratio;
  double radius;    ///< in spacings
  double lattice;   ///< bound of the balance of the ball as it is seeded, under the factor 2
  double along;     ///< of the drop at rest
  double surface;   ///< of the drop at rest
  double pressure;  ///< of the drop at rest, in its middle
};

class LaplaceTest : public testing::TestWithParam<Ball> {};

// p(0) = 2 sigma/R on the ball as it is seeded, R that of its volume. The solver's factor 1.56 stands for 2 on a lattice
// (surface_tension.h), with which the balance is 1.15 / 1.03 / 1.02 at R = 5 / 8 / 12 dx and h = 3 dx, 1.03 / 1.00 / 1.00 at 2.5
// dx: 5 % but for a radius of less than two h.
TEST_P(LaplaceTest, latticeBallBalancesAlongARadius) {
  const auto world = makeWorld(drop(GetParam().support_ratio, GetParam().radius, 0.5));
  const double ratio = radialBalance(*world).along * 2.0 / 1.56;
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_NEAR(ratio, 1.0, GetParam().lattice);
}

// The same of the drop at rest, beside the pressure itself in its middle; means over time, because a drop rings at the speed of
// sound. At R = 5 / 8 / 12 dx and h = 3 dx the balance is 1.33 / 1.21 / 1.11: the design's 5 % is out of its reach, because the
// packed outermost centres stand 0.85 dx inside R and the formula gives their force the weight (R/r)^2, 1.25 at 8 dx. With all of
// it on the surface it is 0.92 / 0.95 / 0.95. What the drop really has, 1.03 / 1.02 / 1.02, lies between and keeps the 5 %.
// At 2.5 dx, where 30 % are allowed: 1.17 / 1.07 / 1.13, 0.86 / 0.87 / 1.00 and 1.06 / 0.93 / 1.11. The largest drop has half the
// time to come to rest.
TEST_P(LaplaceTest, dropAtRestHasLaplacesPressure) {
  const Ball& ball = GetParam();
  const bool large = ball.radius > 10.0;
  sph::WorldDescription scene = restarted(*restingDrop(ball.support_ratio, ball.radius, large ? 0.05 : 0.1));
  scene.effects.viscosity->viscosity = 0.05;
  const auto world = makeWorld(scene);
  const double laplace = 2.0 * kSigma / radiusOf(*world);
  runFor(*world, large ? 0.05 : 0.1);
  double pressure = 0.0;
  RadialBalance balance;
  int pressures = 0;
  int balances = 0;
  runFor(*world, large ? 0.05 : 0.2, [&] {
    if (world->stepCount() % 5 == 0) {
      pressure += corePressure(*world) / laplace;
      ++pressures;
    }
    if (world->stepCount() % 20 == 0) {
      const RadialBalance now = radialBalance(*world);
      balance.along += now.along;
      balance.surface += now.surface;
      ++balances;
    }
  });
  RecordProperty("pressure", std::to_string(pressure / pressures));
  RecordProperty("along", std::to_string(balance.along / balances));
  RecordProperty("surface", std::to_string(balance.surface / balances));
  EXPECT_NEAR(balance.along / balances, 1.0, ball.along);
  EXPECT_NEAR(balance.surface / balances, 1.0, ball.surface);
  EXPECT_NEAR(pressure / pressures, 1.0, ball.pressure);
}

INSTANTIATE_TEST_SUITE_P(drops, LaplaceTest,
                         testing::Values(Ball{"three_5", 3.0, 5.0, 0.16, 0.40, 0.10, 0.05},
                                         Ball{"three_8", 3.0, 8.0, 0.05, 0.25, 0.06, 0.05},
                                         Ball{"three_12", 3.0, 12.0, 0.05, 0.15, 0.10, 0.05},
                                         Ball{"twoAndAHalf_5", 2.5, 5.0, 0.05, 0.30, 0.20, 0.30},
                                         Ball{"twoAndAHalf_8", 2.5, 8.0, 0.05, 0.15, 0.15, 0.10},
                                         Ball{"twoAndAHalf_12", 2.5, 12.0, 0.05, 0.20, 0.15, 0.20}),
                         [](const auto& tested) { return tested.param.name; });

struct Accuracy {
  const char* name;
  double support_ratio;
  double period;  ///< relative
};

class DropTest : public testing::TestWithParam<Accuracy> {};

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
  EXPECT_LT(momentumOf(*world).norm(), 1e-6 * momentumScaleOf(*world));
}

INSTANTIATE_TEST_SUITE_P(supportRatios, DropTest,
                         testing::Values(Accuracy{"twoAndAHalf", 2.5, 0.30}, Accuracy{"three", 3.0, 0.12}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::test
