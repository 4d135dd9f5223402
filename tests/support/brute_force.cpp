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

/// Of a pair, on the first: `offset` from the second to the first, `velocity` of the first against the second.
Vec3 repulsionOf(const sph::WorldDescription& d, double c0, const Vec3& offset, const Vec3& velocity) {
  const sph::RepulsionSettings& settings = *d.effects.repulsion;
  const double contact = settings.contact_distance * d.spacing;
  const double distance = std::max(offset.norm(), contact / 2.0);
  const double pe = contact / distance;
  if (pe < 1.0) return Vec3::Zero();
  const Vec3 direction = offset.normalized();
  const double push =
      settings.strength * c0 * c0 * d.spacing * (std::pow(pe, settings.power_1) - std::pow(pe, settings.power_2)) / (distance * distance);
  return (push - settings.damping * c0 / d.spacing * (pe - 1.0) * velocity.dot(direction)) * direction;
}

}  // namespace

OracleFields bruteForce(const sph::WorldDescription& d, sph::PairSet set, const OracleParticles& particles) {
  const sph::SmoothingKernel kernel = d.densityKernel();
  const sph::RestLattice lattice = sph::calibrateRestLattice(kernel, d.spacing, d.rest_density);
  const double mass = lattice.particle_mass;
  const double c0 = sph::speedOfSound(d);
  const std::size_t n = particles.position.size();

  OracleFields fields;
  fields.density.assign(n, 0.0);
  fields.acceleration.assign(n, Vec3::Zero());
  fields.platelet_rate.assign(n, 0.0);
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
  const auto pressure = [&](std::size_t i) {
    const double background = d.effects.pressure ? d.effects.pressure->background_pressure : 0.0;
    return std::max(0.0, background + c0 * c0 * (fields.density[i] - d.rest_density));
  };
  for (std::size_t i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](std::size_t j, const Vec3& offset, double r) {
      if (j == i || r == 0.0) return;  // the gradient of the kernels vanishes in the middle
      const double own = fields.density[i];
      const double other = fields.density[j];
      const Vec3 gradient = kernel.slope(r) / r * offset;
      const double laplacian = offset.dot(gradient) / (r * r + 0.01 * kernel.h * kernel.h) * lattice.viscosity_factor;
      const Vec3 velocity = particles.velocity[i] - particles.velocity[j];
      if (set.pressure == sph::PressureTerm::variational) {
        fields.acceleration[i] -= mass * (pressure(i) / (own * own) + pressure(j) / (other * other)) * gradient;
      } else if (set.pressure == sph::PressureTerm::symmetric) {
        fields.acceleration[i] -= mass * (pressure(i) + pressure(j)) / (2.0 * own * other) * gradient;
      }
      if (set.viscosity != sph::ViscosityTerm::none) {
        double viscosity = d.effects.viscosity->viscosity;
        if (set.viscosity == sph::ViscosityTerm::harmonic) {
          viscosity = 2.0 * particles.viscosity[i] * particles.viscosity[j] / (particles.viscosity[i] + particles.viscosity[j]);
        }
        fields.acceleration[i] += mass * 2.0 * viscosity / (own * other) * laplacian * velocity;
      }
      if (set.platelets) {
        fields.platelet_rate[i] += d.effects.platelets->diffusivity * mass * (1.0 / own + 1.0 / other) * laplacian *
                                   (particles.platelet[i] - particles.platelet[j]);
      }
      if (set.repulsion) fields.acceleration[i] += repulsionOf(d, c0, offset, velocity);
    });
  }
  return fields;
}

}  // namespace bleedsim::test
