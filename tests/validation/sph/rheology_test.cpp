// Blood that thins between plates, physics.md section 5 case 7, and the stress between layers of unlike blood, case 6.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "tests/unit/sph/pass_rig.h"
#include "tests/validation/sph/channel.h"

namespace bleedsim::test {
namespace {

constexpr double kHalf = 0.005;  // a, m: plates at y = +-a
constexpr int kRows = 20;

struct PlaneFlow {
  double gradient;  // G, Pa/m
  sph::Rheology rheology;
  std::function<double(double)> at;  // u(y), m/s
  double largest;                    // m/s
};

/// The channel of `flow`, h = 2.5 dx, started at `start` times the profile.
std::unique_ptr<sph::World> plates(const PlaneFlow& flow, double start) {
  sph::WorldDescription scene = channel(kRows, 2.0 * kHalf, 2.5, true, {flow.gradient / kRestDensity, 0, 0});
  scene.compressibility.design_speed = flow.largest;
  scene.effects.viscosity->rheology = flow.rheology;
  scene.effects.viscosity->solve = sph::ViscositySolve::explicit_;
  scene.fluid_blocks = blocksWithFlow(scene.fluid_blocks.front(), scene.spacing, 1, [&](const sph::Vec3& x) {
    return sph::Vec3{start * flow.at(x.z() - kHalf), 0, 0};
  });
  return makeWorld(scene);
}

double errorOf(const sph::World& world, const PlaneFlow& flow) {
  return profileError(world, kRows, [&](double z) { return flow.at(z - kHalf); });
}

double meanSpeed(const PlaneFlow& flow) {
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) sum += flow.at(kHalf * (k + 0.5) / kSteps);
  return sum / kSteps;
}

/// Beyond y_c = tau_y/G: u = [G (a^2 - y^2)/2 + tau_y (a - y) - (4/3) sqrt(tau_y G) (a^1.5 - y^1.5)]/mu_c; the plug within moves
/// as one.
PlaneFlow cassonFlow() {
  const sph::CassonRheology law;
  const auto at = [law](double y) {
    const double g = 10.0;
    const double r = std::max(std::abs(y), law.yield_stress / g);
    return (0.5 * g * (kHalf * kHalf - r * r) + law.yield_stress * (kHalf - r) -
            4.0 / 3.0 * std::sqrt(law.yield_stress * g) * (std::pow(kHalf, 1.5) - std::pow(r, 1.5))) /
           law.viscosity;
  };
  return {10.0, law, at, at(0.0)};
}

/// mu(g) g = G y, solved by bisection, and integrated from the plate inwards; linear between 2000 nodes.
PlaneFlow carreauFlow() {
  constexpr int kNodes = 2000;
  const sph::CarreauYasudaRheology law;
  const double gradient = 22.81;
  const auto stress = [&](double g) {
    return g *
           (law.infinite_shear + (law.zero_shear - law.infinite_shear) *
                                     std::pow(1.0 + std::pow(law.time * g, law.transition), (law.power - 1.0) / law.transition));
  };
  std::vector<double> speed(kNodes + 1, 0.0);
  for (int k = kNodes - 1; k >= 0; --k) {
    double low = 0.0;
    double high = 1000.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (stress(middle) < gradient * kHalf * (k + 0.5) / kNodes ? low : high) = middle;
    }
    speed[static_cast<std::size_t>(k)] = speed[static_cast<std::size_t>(k) + 1] + low * kHalf / kNodes;
  }
  const double largest = speed[0];
  const auto at = [speed = std::move(speed)](double y) {
    const double node = std::min(std::abs(y) / kHalf, 1.0) * kNodes;
    const auto k = static_cast<std::size_t>(std::min(node, kNodes - 1.0));
    return speed[k] + (node - static_cast<double>(k)) * (speed[k + 1] - speed[k]);
  };
  return {gradient, law, at, largest};
}

TEST(PlaneFlowOfThinningBlood, ProfilesAreThoseOfTheDesign) {
  const PlaneFlow casson = cassonFlow();
  EXPECT_NEAR(casson.largest, 0.0126, 5e-5);
  EXPECT_NEAR(casson.largest / meanSpeed(casson), 1.356, 1e-3);
  const PlaneFlow carreau = carreauFlow();
  EXPECT_NEAR(carreau.largest, 0.02716, 2e-5);
  EXPECT_NEAR(meanSpeed(carreau), 0.020, 2e-5);
  EXPECT_NEAR(carreau.at(0.5 * kHalf) / carreau.largest, 0.860, 1e-3);
  EXPECT_NEAR(carreau.at(0.9 * kHalf) / carreau.largest, 0.249, 1e-3);
}

// 20 across, h = 2.5 dx. A disturbance dies within (2 a)^2 rho/(pi^2 mu) = 3 s at mu_c, sooner where mu is larger. Started at its
// profile the flow must stay, L2 <= 1 % (the case asks for 5 %; 0.4 % was measured): a viscosity wrong by 5 % would have moved it
// by 2 %. Started at nine tenths of it the flow must have come closer, to 5 %.
void expectProfile(const PlaneFlow& flow) {
  for (const double start : {1.0, 0.9}) {
    const auto world = plates(flow, start);
    runFor(*world, 2.0);
    const double error = errorOf(*world, flow);
    testing::Test::RecordProperty("l2_from_" + std::to_string(start), std::to_string(error));
    EXPECT_LT(error, start == 1.0 ? 0.01 : 0.05);
    expectInvariants(*world);
  }
}

TEST(PlaneFlowOfThinningBlood, Casson) { expectProfile(cassonFlow()); }
TEST(PlaneFlowOfThinningBlood, Carreau) { expectProfile(carreauFlow()); }

// Two layers of a plane Couette flow, mu 1:100, the stress tau in both: u = tau z/mu_k on either side of z = 0. The pairs within
// the lower layer cancel, so its force is the stress of the upper one, tau x area; its own lower face is free. A particle stands
// for rho0 dx^3 of blood (its calibrated mass is that over the kernel's lattice sum). 2 %; the harmonic mean is exact, the
// arithmetic one 25 times too large.
TEST(TwoLayerCouette, TheInterfaceCarriesTheStress) {
  constexpr double kThin = 0.004;
  constexpr double kThick = 0.4;
  constexpr double kStress = 0.02;  // Pa
  constexpr int kSide = 8;
  for (const double support_ratio : {2.0, 2.5}) {
    sph::WorldDescription scene = emptyScene();
    scene.support_ratio = support_ratio;
    scene.domain.periodic = {true, true, false};
    scene.domain.lower = {0, 0, -0.02};
    scene.domain.upper = {kSide * kSpacing, kSide * kSpacing, 0.02};
    scene.effects.viscosity.emplace();
    addBlock(scene, {0, 0, -8 * kSpacing}, {kSide, kSide, 16});
    scene.fluid_blocks.back().viscosity = kThin;  // one unlike the scene's: the harmonic form
    OracleParticles particles;
    sph::JitterSource none{1};
    sph::seedBlock(scene.fluid_blocks.front(), scene.spacing, none, [&](const sph::Vec3& x) {
      const double viscosity = x.z() < 0.0 ? kThin : kThick;
      particles.position.push_back(x);
      particles.velocity.push_back({kStress / viscosity * x.z(), 0, 0});
      particles.viscosity.push_back(viscosity);
    });
    const sph::PassRig<double> rig{scene, sph::SimdTarget::scalar, particles};
    const double mass = scene.rest_density * scene.particleVolume();
    double force = 0.0;
    for (std::size_t i = 0; i < particles.position.size(); ++i) {
      if (particles.position[i].z() < 0.0) force += mass * rig.acceleration()[i].x();
    }
    const double area = kSide * kSpacing * kSide * kSpacing;
    RecordProperty("stress_ratio_" + std::to_string(support_ratio), std::to_string(force / (kStress * area)));
    EXPECT_NEAR(force / (kStress * area), 1.0, 0.02);
  }
}

}  // namespace
}  // namespace bleedsim::test
