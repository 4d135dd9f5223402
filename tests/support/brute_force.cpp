#include "tests/support/brute_force.h"

#include <algorithm>
#include <cmath>

#include "service/sph/rest_lattice.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

Vec3 nearestOffset(const sph::Domain& domain, Vec3 offset) {
  for (Eigen::Index a = 0; a < 3; ++a) {
    if (!domain.periodic[static_cast<std::size_t>(a)]) continue;
    const double side = domain.upper[a] - domain.lower[a];
    offset[a] -= side * std::round(offset[a] / side);
  }
  return offset;
}

}  // namespace

OracleFields bruteForce(const sph::WorldDescription& d, sph::PairSet set, const OracleParticles& particles) {
  const sph::SmoothingKernel kernel{sph::KernelType::wendland_c2, d.supportRadius()};
  const sph::RestLattice lattice = sph::calibrateRestLattice(kernel, d.spacing, d.rest_density);
  const double mass = lattice.particle_mass;
  const double c0 = sph::speedOfSound(d);
  const std::size_t n = particles.position.size();

  OracleFields fields;
  fields.density.assign(n, 0.0);
  fields.acceleration.assign(n, Vec3::Zero());
  fields.neighbors.assign(n, 0);
  const auto for_each_neighbor = [&](std::size_t i, auto&& visit) {
    for (std::size_t j = 0; j < n; ++j) {
      const Vec3 offset = nearestOffset(d.domain, particles.position[i] - particles.position[j]);
      const double r = offset.norm();
      if (r < kernel.h) visit(j, offset, r);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](std::size_t, const Vec3&, double r) {
      fields.density[i] += mass * kernel.value(r);
      ++fields.neighbors[i];
    });
  }
  const auto pressure_term = [&](std::size_t i) {
    const double background = d.effects.pressure ? d.effects.pressure->background_pressure : 0.0;
    const double density = fields.density[i];
    return std::max(0.0, background + c0 * c0 * (density - d.rest_density)) / (density * density);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](std::size_t j, const Vec3& offset, double r) {
      if (j == i || r == 0.0) return;  // the gradient of Wendland C2 vanishes in the middle
      const Vec3 gradient = kernel.slope(r) / r * offset;
      if (set.pressure == sph::PressureTerm::variational) {
        fields.acceleration[i] -= mass * (pressure_term(i) + pressure_term(j)) * gradient;
      }
      if (set.viscosity == sph::ViscosityTerm::none) return;
      double viscosity = d.effects.viscosity->viscosity;
      if (set.viscosity == sph::ViscosityTerm::harmonic) {
        const double own = particles.viscosity[i];
        const double other = particles.viscosity[j];
        viscosity = 2.0 * own * other / (own + other);
      }
      const double drag = 2.0 * lattice.viscosity_factor * viscosity / (fields.density[i] * fields.density[j]) *
                          offset.dot(gradient) / (r * r + 0.01 * kernel.h * kernel.h);
      fields.acceleration[i] += mass * drag * (particles.velocity[i] - particles.velocity[j]);
    });
  }
  return fields;
}

}  // namespace bleedsim::test
