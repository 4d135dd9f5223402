#include "service/sph/rest_lattice.h"

#include <cmath>

namespace bleedsim::sph {

RestLattice calibrateRestLattice(const SmoothingKernel& kernel, double spacing, double rest_density) {
  return calibrateRestLattice(kernel, spacing, rest_density, kernel.h);
}

RestLattice calibrateRestLattice(const SmoothingKernel& kernel, double spacing, double rest_density, double softening_radius) {
  const int reach = static_cast<int>(std::ceil(kernel.h / spacing));
  const double softening = 0.01 * softening_radius * softening_radius;
  double kernel_sum = 0.0;
  double laplacian_sum = 0.0;  // of v = r^2/(2 d), whose Laplacian is 1
  const int layers = kernel.planar() ? 0 : reach;
  const double twice_dimension = kernel.planar() ? 4.0 : 6.0;
  for (int z = -layers; z <= layers; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double r = spacing * std::sqrt(static_cast<double>(x * x + y * y + z * z));
        kernel_sum += kernel.value(r);
        laplacian_sum += -2.0 * r * kernel.slope(r) / (r * r + softening) * r * r / twice_dimension;
      }
    }
  }
  const double volume = 1.0 / kernel_sum;  // m / rho0
  return {.particle_mass = rest_density * volume, .viscosity_factor = 1.0 / (volume * laplacian_sum)};
}

}  // namespace bleedsim::sph
