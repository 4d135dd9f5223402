// The oracle of the pair passes: every particle against every other in double precision, from the closed forms of the kernel.
#pragma once

#include <vector>

#include "service/sph/effects/pair_set.h"
#include "service/sph/world_description.h"

namespace bleedsim::test {

/// Particles in SI units; `viscosity` (Pa s) is read by the harmonic term only, `platelet` by their diffusion,
/// `radius` (own support radius over h) with (34) only.
struct OracleParticles {
  std::vector<sph::Vec3> position;
  std::vector<sph::Vec3> velocity;
  std::vector<double> viscosity;
  std::vector<double> platelet;
  std::vector<double> radius;
};

struct OracleFields {
  std::vector<double> density;          ///< kg/m^3
  std::vector<sph::Vec3> acceleration;  ///< m/s^2, of pressure, viscosity and repulsion
  std::vector<double> platelet_rate;    ///< 1/s, of diffusion
  std::vector<int> neighbors;           ///< within the larger support of the two, the particle itself included
};

/// Density (20), pressure (16)(17)(19), viscosity (25), platelet diffusion (27) and repulsion (36) as their headers in
/// service/sph/effects state them, with the settings of the description, without tissue; core radius (34) as the mean of both
/// particles' kernels, calibrated at five radii. Sees the nearest image across periodic sides. O(n^2).
OracleFields bruteForce(const sph::WorldDescription& description, sph::PairSet set, const OracleParticles& particles);

}  // namespace bleedsim::test
