#include "service/sph/rest_lattice.h"

#include <gtest/gtest.h>

namespace bleedsim::sph {
namespace {

TEST(RestLattice, viscosityFactorsOfWendland) {
  const double spacing = 0.002;
  const auto factor = [&](double ratio) {
    return calibrateRestLattice({.h = ratio * spacing}, spacing, 1000.0).viscosity_factor;
  };
  EXPECT_NEAR(factor(2.0), 1.0843, 1e-4);
  EXPECT_NEAR(factor(2.5), 1.0734, 1e-4);
  EXPECT_NEAR(factor(3.0), 1.0427, 1e-4);
}

TEST(RestLattice, massUndoesTheLatticeErrorOfTheSum) {
  const double spacing = 0.002;
  const double volume = spacing * spacing * spacing;
  const auto sum = [&](double ratio) {  // rho / rho0 with the mass rho0 dx^3
    return 1000.0 * volume / calibrateRestLattice({.h = ratio * spacing}, spacing, 1000.0).particle_mass;
  };
  EXPECT_NEAR(sum(2.0), 1.034, 1e-3);
  EXPECT_NEAR(sum(2.5), 1.013, 1e-3);
  EXPECT_NEAR(sum(3.0), 1.003, 1e-3);
}

TEST(RestLattice, doesNotDependOnTheUnitOfLength) {
  for (const KernelType type : {KernelType::wendland_c2, KernelType::cubic_spline}) {
    const RestLattice metres = calibrateRestLattice({.type = type, .h = 0.0025}, 0.001, 1060.0);
    const RestLattice spacings = calibrateRestLattice({.type = type, .h = 2.5}, 1.0, 1060.0);
    EXPECT_NEAR(metres.particle_mass / (spacings.particle_mass * 1e-9), 1.0, 1e-12);
    EXPECT_NEAR(metres.viscosity_factor, spacings.viscosity_factor, 1e-12);
  }
}

}  // namespace
}  // namespace bleedsim::sph
