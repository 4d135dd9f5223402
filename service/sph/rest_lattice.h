// Calibration on the rest lattice: the cubic lattice of spacing dx that blood at rest is measured against, or
// the square lattice of one layer for a planar kernel.
#pragma once

#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {

struct RestLattice {
  double particle_mass = 0.0;     ///< kg; m with m sum_j W = rho0 on the lattice, the self term included
  double viscosity_factor = 1.0;  ///< multiplies mu, so that the Brookshaw sum gives the exact Laplacian of a parabola
};

/// physics.md section 2: the factor of Wendland C2 is 1.0843 / 1.0734 / 1.0427 at h = 2 / 2.5 / 3 dx.
RestLattice calibrateRestLattice(const SmoothingKernel& kernel, double spacing, double rest_density);
/// Where the pairs' 0.01 h^2 is that of another support radius than the kernel's, m.
RestLattice calibrateRestLattice(const SmoothingKernel& kernel, double spacing, double rest_density, double softening_radius);

}  // namespace bleedsim::sph
