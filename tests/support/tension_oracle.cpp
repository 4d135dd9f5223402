#include "tests/support/tension_oracle.h"

#include <algorithm>
#include <cmath>

#include "service/sph/rest_lattice.h"
#include "service/sph/smoothing_kernel.h"
#include "tests/support/nearest_offset.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

class Oracle {
 public:
  Oracle(const sph::WorldDescription& d, const OracleParticles& particles, const std::vector<double>& radius)
      : d_{d}, particles_{particles}, radius_{radius} {}

  double h() const { return d_.supportRadius(); }
  double volume() const {
    return sph::calibrateRestLattice({d_.kernel, h()}, d_.spacing, d_.rest_density).particle_mass / d_.rest_density;
  }
  Vec3 offset(std::size_t i, std::size_t j) const {
    return nearestOffset(d_.domain, particles_.position[i] - particles_.position[j]);
  }
  double weight(std::size_t i, std::size_t j) const {
    const double r = offset(i, j).norm();
    return 0.5 * (kernelOf(i).value(r) + kernelOf(j).value(r));
  }
  Vec3 gradient(std::size_t i, std::size_t j) const {
    const Vec3 r = offset(i, j);
    const double distance = r.norm();
    if (distance == 0.0) return Vec3::Zero();
    return 0.5 * (kernelOf(i).slope(distance) + kernelOf(j).slope(distance)) / distance * r;
  }

 private:
  sph::SmoothingKernel kernelOf(std::size_t i) const { return {d_.kernel, radius_.empty() ? h() : radius_[i]}; }

  const sph::WorldDescription& d_;
  const OracleParticles& particles_;
  const std::vector<double>& radius_;
};

Vec3 turned(const Vec3& unit, const TissueAt& tissue, double angle, double h) {
  const Vec3 tangent = unit - unit.dot(tissue.normal) * tissue.normal;
  if (tangent.norm() < 0.1) return unit;
  const double own = std::clamp(tissue.distance / h, 0.0, 1.0);
  const Vec3 wanted = std::sin(angle) * tangent.normalized() - std::cos(angle) * tissue.normal;
  return (own * unit + (1.0 - own) * wanted).normalized();
}

}  // namespace

TensionFields bruteForceTension(const sph::WorldDescription& d, const OracleParticles& particles,
                                const std::vector<double>& radius, const std::vector<TissueAt>& tissue) {
  const Oracle oracle{d, particles, radius};
  const sph::SurfaceTensionSettings& settings = *d.effects.surface_tension;
  const std::size_t n = particles.position.size();
  const double h = oracle.h();
  TensionFields fields;
  std::vector<Vec3> unit(n, Vec3::Zero());
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 normal = tissue.empty() ? Vec3::Zero() : tissue[i].gradient;
    for (std::size_t j = 0; j < n; ++j) normal += oracle.volume() * oracle.gradient(i, j);
    const double weight = std::clamp(normal.norm() * h / settings.normal_cutoff - 1.0, 0.0, 1.0);
    if (weight > 0.0) {
      unit[i] = normal.normalized();
      const bool touches = !tissue.empty() && tissue[i].normal.norm() > 0.0;
      if (touches && settings.contact_angle) unit[i] = turned(unit[i], tissue[i], *settings.contact_angle, h);
    }
    fields.weight.push_back(weight);
    fields.normal.emplace_back(normal.norm() * unit[i]);
  }
  const double nu = 0.2 * std::sqrt(settings.coefficient / d.rest_density * h);
  for (std::size_t i = 0; i < n; ++i) {
    double turn = 0.0;
    double sum = 0.0;
    Vec3 drag = Vec3::Zero();
    for (std::size_t j = 0; j < n && fields.weight[i] > 0.0; ++j) {
      const Vec3 gradient = oracle.gradient(i, j);
      const Vec3 offset = oracle.offset(i, j);
      turn += fields.weight[j] * (unit[j] - unit[i]).dot(gradient);
      sum += fields.weight[j] * oracle.weight(i, j);
      drag += fields.weight[j] * (particles.velocity[i] - particles.velocity[j]).dot(offset) /
              (offset.squaredNorm() + 0.01 * h * h) * gradient;
    }
    const double curvature = sum > 0.0 ? std::clamp(-turn / sum, -2.0 / h, 2.0 / h) : 0.0;
    fields.curvature.push_back(curvature);
    fields.acceleration.emplace_back(
        fields.weight[i] *
        (1.56 * settings.coefficient * curvature / d.rest_density * fields.normal[i] + 10.0 * nu * oracle.volume() * drag));
  }
  return fields;
}

}  // namespace bleedsim::test
