// The matrix of the implicit viscosity against its sum over all pairs in double precision.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {
namespace {

struct Expected {
  std::vector<Vec3> product;
  std::vector<double> diagonal;
};

/// a_i = sum_j m 10 mubar/(rho_i rho_j) (v_ij . r_ij)/(r^2 + 0.01 h^2) grad_i W; its block's mean diagonal is a third of the
/// trace.
Expected oracle(const WorldDescription& d, const test::OracleParticles& particles, const std::vector<double>& density) {
  const SmoothingKernel kernel{KernelType::wendland_c2, d.supportRadius()};
  const RestLattice lattice = calibrateRestLattice(kernel, d.spacing, d.rest_density);
  const std::size_t n = particles.position.size();
  Expected expected{std::vector<Vec3>(n, Vec3::Zero()), std::vector<double>(n, 0.0)};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Vec3 offset = particles.position[i] - particles.position[j];
      for (Eigen::Index a = 0; a < 3; ++a) {
        const double side = d.domain.upper[a] - d.domain.lower[a];
        if (d.domain.periodic[static_cast<std::size_t>(a)]) offset[a] -= side * std::round(offset[a] / side);
      }
      const double r = offset.norm();
      if (j == i || r >= kernel.h) continue;
      double viscosity = d.effects.viscosity->viscosity;
      if (viscosityVaries(d)) {
        viscosity = 2.0 * particles.viscosity[i] * particles.viscosity[j] / (particles.viscosity[i] + particles.viscosity[j]);
      }
      const double weight = lattice.particle_mass * 10.0 * viscosity * lattice.viscosity_factor / (density[i] * density[j]) *
                            kernel.slope(r) / r / (r * r + 0.01 * kernel.h * kernel.h);
      expected.product[i] += weight * (particles.velocity[i] - particles.velocity[j]).dot(offset) * offset;
      expected.diagonal[i] += weight * r * r / 3.0;
    }
  }
  return expected;
}

WorldDescription stirredBox(bool harmonic, bool periodic) {
  const PairSet set{PressureTerm::variational, harmonic ? ViscosityTerm::harmonic : ViscosityTerm::uniform};
  WorldDescription description = withPairSet(test::periodicBox({9, 8, 7}, 0.3), set);
  description.domain.periodic = {periodic, periodic, periodic};
  return description;
}

class ViscousProduct : public testing::TestWithParam<std::tuple<bool, bool>> {
 protected:
  WorldDescription scene() const { return stirredBox(std::get<0>(GetParam()), std::get<1>(GetParam())); }

  template <class Real>
  void expectOracle(SimdTarget target, double tolerance) {
    PassRig<Real> rig{scene(), target, stirred(scene()), 2};
    std::vector<double> diagonal;
    const std::vector<Vec3> product = rig.viscousProduct(target, scene(), diagonal);
    const Expected expected = oracle(scene(), rig.rounded(), rig.density());
    ASSERT_GT(largestNorm(expected.product), 1.0);
    EXPECT_LT(largestDifference(product, expected.product), tolerance * largestNorm(expected.product));
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
      EXPECT_LT(diagonal[i], 0.0);
      EXPECT_NEAR(diagonal[i], expected.diagonal[i], -tolerance * expected.diagonal[i]);
    }
  }
};

TEST_P(ViscousProduct, EqualsBruteForceOnEveryTarget) {
  expectOracle<double>(SimdTarget::scalar, 1e-12);
  for (const SimdTarget target : availableSimdTargets()) expectOracle<float>(target, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(All, ViscousProduct, testing::Combine(testing::Bool(), testing::Bool()), [](const auto& tested) {
  return std::string{std::get<0>(tested.param) ? "Harmonic" : "Uniform"} + (std::get<1>(tested.param) ? "Periodic" : "Open");
});

class ViscousMomentum : public testing::TestWithParam<bool> {};

/// Sums over the particles of the product and of x cross the product, to within `tolerance` of the sums of their magnitudes.
template <class Real>
void expectBalance(const WorldDescription& scene, SimdTarget target, double tolerance) {
  PassRig<Real> rig{scene, target, stirred(scene)};
  std::vector<double> diagonal;
  const std::vector<Vec3> product = rig.viscousProduct(target, scene, diagonal);
  const test::OracleParticles particles = rig.rounded();
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  double force_scale = 0.0;
  double torque_scale = 0.0;
  for (std::size_t i = 0; i < product.size(); ++i) {
    const Vec3 moment = particles.position[i].cross(product[i]);
    force += product[i];
    torque += moment;
    force_scale += product[i].norm();
    torque_scale += moment.norm();
  }
  EXPECT_LT(force.norm(), tolerance * force_scale) << simdTargetName(target);
  EXPECT_LT(torque.norm(), tolerance * torque_scale) << simdTargetName(target);
}

// Forces along the pair: neither momentum nor angular momentum changes.
TEST_P(ViscousMomentum, StaysLinearAndAngular) {
  const WorldDescription scene = stirredBox(GetParam(), false);
  expectBalance<double>(scene, SimdTarget::scalar, 1e-12);
  for (const SimdTarget target : availableSimdTargets()) expectBalance<float>(scene, target, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, ViscousMomentum, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Harmonic" : "Uniform"; });

}  // namespace
}  // namespace bleedsim::sph
