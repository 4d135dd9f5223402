#include "tests/support/literal_oracle.h"

#include <cmath>
#include <numbers>

#include "service/sph/smoothing_kernel.h"
#include "tests/support/nearest_offset.h"

namespace bleedsim::test {
namespace {

using sph::KernelType;
using sph::SmoothingKernel;
using sph::Vec3;

/// m with m sum W = rho0 over the cubic (in the plane: square) lattice of spacing dx.
double calibratedMass(const sph::WorldDescription& d, const SmoothingKernel& density) {
  const int reach = static_cast<int>(std::ceil(d.support_ratio));
  const int layers = d.planar ? 0 : reach;
  double sum = 0.0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -layers; z <= layers; ++z) sum += density.value(d.spacing * Vec3{double(x), double(y), double(z)}.norm());
    }
  }
  return d.rest_density / sum;
}

}  // namespace

OracleFields literalOracle(const sph::WorldDescription& d, const OracleParticles& particles) {
  const double h = d.supportRadius();
  const double layer = d.planar ? d.spacing : 0.0;
  const SmoothingKernel poly6{KernelType::poly6, h, layer};
  const SmoothingKernel spiky{KernelType::spiky, h, layer};
  const SmoothingKernel viscous{KernelType::viscosity, h, layer};
  const double mass = calibratedMass(d, poly6);
  const double c0 = sph::speedOfSound(d);
  const double stiffness = d.literal.stiffness.value_or(c0 * c0);
  const double strength = d.literal.repulsion.value_or(1.5 * mass * c0 * c0 * d.spacing);
  const std::size_t n = particles.position.size();

  OracleFields fields;
  fields.density.assign(n, 0.0);
  fields.acceleration.assign(n, Vec3::Zero());
  fields.platelet_rate.assign(n, 0.0);
  fields.neighbors.assign(n, 0);
  const auto for_each_neighbor = [&](std::size_t i, auto&& visit) {
    for (std::size_t j = 0; j < n; ++j) {
      const Vec3 offset = nearestOffset(d.domain, particles.position[i] - particles.position[j]);
      if (offset.norm() < h) visit(j, offset, offset.norm());
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](std::size_t, const Vec3&, double r) {
      fields.density[i] += mass * poly6.value(r);
      ++fields.neighbors[i];
    });
  }
  const auto pressure = [&](std::size_t i) { return stiffness * (fields.density[i] - d.rest_density); };
  const auto viscosity = [&](std::size_t i) {
    if (d.effects.platelets) {
      const double b = d.literal.thickening;
      const double a =
          d.literal.thickening_exponent.value_or(std::log(b / d.effects.viscosity->viscosity) / d.effects.platelets->fresh);
      return b * std::exp(-a * particles.platelet[i]);
    }
    return particles.viscosity.empty() ? d.effects.viscosity->viscosity : particles.viscosity[i];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double own = fields.density[i];
    Vec3& a = fields.acceleration[i];
    Vec3 normal = Vec3::Zero();
    double laplacian_of_color = 0.0;
    for_each_neighbor(i, [&](std::size_t j, const Vec3& offset, double r) {
      if (j == i || r == 0.0) return;
      const double pe = 2.0 * d.literal.contact_radius * d.spacing / r;
      if (d.effects.repulsion && pe > 1.0) {
        a += strength / mass * (std::pow(pe, d.literal.power_1) - std::pow(pe, d.literal.power_2)) / (r * r) * offset / r;
        return;
      }
      const double other = fields.density[j];
      const Vec3 gradient = spiky.slope(r) / r * offset;
      if (d.effects.pressure) {
        if (d.literal.pressure == sph::PressureForm::symmetric) {
          a -= mass * (pressure(i) + pressure(j)) / (2.0 * own * other) * gradient;
        } else {
          a -= mass * (pressure(i) / (own * own) + pressure(j) / (other * other)) * gradient;
        }
      }
      normal += mass / other * gradient;
      laplacian_of_color += mass / other * spiky.laplacian(r);
      if (d.effects.viscosity) {
        a += viscosity(i) * mass / (own * other) * viscous.laplacian(r) * (particles.velocity[j] - particles.velocity[i]);
      }
      if (d.effects.platelets) {
        fields.platelet_rate[i] += d.literal.platelet_diffusivity * mass / other * viscous.laplacian(r) *
                                   (particles.platelet[j] - particles.platelet[i]);
      }
    });
    if (d.effects.surface_tension && normal.norm() * h > d.literal.normal_cutoff) {
      a -= d.literal.tension * laplacian_of_color / own * normal.normalized();
    }
  }
  return fields;
}

}  // namespace bleedsim::test
