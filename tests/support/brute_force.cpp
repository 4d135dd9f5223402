#include "tests/support/brute_force.h"

#include <algorithm>
#include <cmath>

#include "service/sph/rest_lattice.h"
#include "service/sph/smoothing_kernel.h"
#include "service/sph/world_setup.h"
#include "tests/support/nearest_offset.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

/// Of a pair, on the first: `offset` from the second to the first, `velocity` of the first against the second.
Vec3 repulsionOf(const sph::WorldDescription& d, double c0, const Vec3& offset, const Vec3& velocity) {
  const sph::RepulsionSettings& settings = *d.effects.repulsion;
  const double contact = settings.contact_distance * d.spacing;
  const double distance = std::max(offset.norm(), contact / sph::contactOverlap(settings));
  const double pe = contact / distance;
  if (pe < 1.0) return Vec3::Zero();
  const Vec3 direction = offset.normalized();
  const double push = settings.strength * c0 * c0 * d.spacing *
                      (std::pow(pe, settings.power_1) - std::pow(pe, settings.power_2)) / (distance * distance);
  return (push - settings.damping * c0 / d.spacing * (pe - 1.0) * velocity.dot(direction)) * direction;
}

/// Mass and viscosity factor of the rest lattice at a particle's own radius, over those at h, linear between five radii.
sph::RestLattice factorsAt(const sph::WorldDescription& d, double radius) {
  const auto exact = [&](double at) {
    return sph::calibrateRestLattice({d.kernel, at * d.supportRadius()}, d.spacing, d.rest_density, d.supportRadius());
  };
  const double width = (d.effects.core_radius->largest - 1.0) / 3.0;
  double below = d.effects.core_radius->smallest;
  double above = 1.0;
  while (radius > above) {
    below = above;
    above += width;
  }
  const double part = (radius - below) / (above - below);
  const sph::RestLattice a = exact(below);
  const sph::RestLattice b = exact(above);
  const sph::RestLattice one = exact(1.0);
  return {((1.0 - part) * a.particle_mass + part * b.particle_mass) / one.particle_mass,
          ((1.0 - part) * a.viscosity_factor + part * b.viscosity_factor) / one.viscosity_factor};
}

}  // namespace

OracleFields bruteForce(const sph::WorldDescription& d, sph::PairSet set, const OracleParticles& particles) {
  const sph::SmoothingKernel kernel = d.densityKernel();
  const sph::RestLattice lattice = sph::calibrateRestLattice(kernel, d.spacing, d.rest_density);
  const double mass = lattice.particle_mass;
  const double c0 = sph::speedOfSound(d);
  const std::size_t n = particles.position.size();

  std::vector<sph::SmoothingKernel> own_kernel(n, kernel);
  std::vector<sph::RestLattice> factor(n, {1.0, 1.0});
  for (std::size_t i = 0; i < n && set.core_radius; ++i) {
    own_kernel[i].h *= particles.radius[i];
    factor[i] = factorsAt(d, particles.radius[i]);
  }
  const auto value = [&](std::size_t i, std::size_t j, double r) {
    return 0.5 * (factor[i].particle_mass * own_kernel[i].value(r) + factor[j].particle_mass * own_kernel[j].value(r));
  };
  const auto slope = [&](std::size_t i, std::size_t j, double r) {
    return 0.5 * (factor[i].particle_mass * own_kernel[i].slope(r) + factor[j].particle_mass * own_kernel[j].slope(r));
  };

  OracleFields fields;
  fields.density.assign(n, 0.0);
  fields.acceleration.assign(n, Vec3::Zero());
  fields.platelet_rate.assign(n, 0.0);
  fields.neighbors.assign(n, 0);
  const auto for_each_neighbor = [&](std::size_t i, auto&& visit) {
    for (std::size_t j = 0; j < n; ++j) {
      const Vec3 offset = nearestOffset(d.domain, particles.position[i] - particles.position[j]);
      const double r = offset.norm();
      if (r < std::max(own_kernel[i].h, own_kernel[j].h)) visit(j, offset, r);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](std::size_t j, const Vec3&, double r) {
      fields.density[i] += mass * value(i, j, r);
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
      const Vec3 gradient = slope(i, j, r) / r * offset;
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
          const double mine = particles.viscosity[i] * factor[i].viscosity_factor;
          const double other_viscosity = particles.viscosity[j] * factor[j].viscosity_factor;
          viscosity = 2.0 * mine * other_viscosity / (mine + other_viscosity);
        }
        fields.acceleration[i] += mass * 2.0 * viscosity / (own * other) * laplacian * velocity;
      }
      if (d.effects.platelets) {
        fields.platelet_rate[i] += d.effects.platelets->diffusivity * mass * (1.0 / own + 1.0 / other) * laplacian *
                                   (particles.platelet[i] - particles.platelet[j]);
      }
      if (set.repulsion) fields.acceleration[i] += repulsionOf(d, c0, offset, velocity);
    });
  }
  return fields;
}

}  // namespace bleedsim::test
