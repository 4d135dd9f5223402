// The oracle of surface tension: every particle against every other in double precision, as effects/surface_tension.h states it.
#pragma once

#include <vector>

#include "tests/support/brute_force.h"

namespace bleedsim::test {

/// Tissue at a particle: grad L in 1/m, distance in m and normal; all zero far from it.
struct TissueAt {
  sph::Vec3 gradient = sph::Vec3::Zero();
  sph::Vec3 normal = sph::Vec3::Zero();
  double distance = 0.0;
};

struct TensionFields {
  std::vector<sph::Vec3> normal;        ///< n, 1/m, as it acts
  std::vector<double> weight;           ///< w, 0 to 1
  std::vector<double> curvature;        ///< kappa, 1/m; 0 where w = 0
  std::vector<sph::Vec3> acceleration;  ///< m/s^2; no mean is taken off
};

/// `radius` in m, of each particle, or empty for the description's; `tissue` of each particle, or empty.
TensionFields bruteForceTension(const sph::WorldDescription& description, const OracleParticles& particles,
                                const std::vector<double>& radius = {}, const std::vector<TissueAt>& tissue = {});

}  // namespace bleedsim::test
