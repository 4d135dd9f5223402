// The oracle of the pair passes: every particle against every other in double precision, from the closed forms of the kernel.
#pragma once

#include <vector>

#include "service/sph/effects/pair_set.h"
#include "service/sph/world_description.h"

namespace bleedsim::test {

/// Particles in SI units; `viscosity` (Pa s) is read by the harmonic term only.
struct OracleParticles {
  std::vector<sph::Vec3> position;
  std::vector<sph::Vec3> velocity;
  std::vector<double> viscosity;
};

struct OracleFields {
  std::vector<double> density;          ///< kg/m^3
  std::vector<sph::Vec3> acceleration;  ///< m/s^2, of pressure and viscosity
  std::vector<int> neighbors;           ///< within the support, the particle itself included
};

/// Density (20), pressure (16)(19) and viscosity (25) as their headers in service/sph/effects state them, without tissue. Sees
/// the nearest image across periodic sides. O(n^2).
OracleFields bruteForce(const sph::WorldDescription& description, sph::PairSet set, const OracleParticles& particles);

}  // namespace bleedsim::test
