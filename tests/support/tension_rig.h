// Surface tension without a world: a test places any particles, of any support radius, and reads the accelerations in the order
// of placing. Tissue of the description acts by its share alone; kernels of own radii are not calibrated.
#pragma once

#include <optional>
#include <vector>

#include "service/sph/effects/surface_tension.h"
#include "tests/support/particle_rig.h"
#include "tests/support/tension_oracle.h"

namespace bleedsim::sph {

template <class Real>
class TensionRig : public test::ParticleRig<Real> {
 public:
  /// `radius` in m, at most the description's support radius, or empty.
  TensionRig(const WorldDescription& description, SimdTarget target, const test::OracleParticles& particles, int shares = 1,
             const std::vector<double>& radius = {})
      : test::ParticleRig<Real>{description,
                                target,
                                {.set = {.tension = true, .core_radius = !radius.empty()}, .tissue = !description.tissue.empty()},
                                withRadii(particles, radius, description.supportRadius()),
                                shares,
                                std::nullopt},
        walls_{*TissueField<Real>::create(description.tissue, {.kernel = {description.kernel, this->h_},
                                                               .spacing = description.spacing,
                                                               .particle_mass = this->lattice_.particle_mass,
                                                               .rest_density = description.rest_density}),
               wallConstants<Real>(description, this->lattice_, speedOfSound(description)), this->count_, shares},
        wounds_{description, speedOfSound(description)},
        tension_{*description.effects.surface_tension,
                 test::sweepsOf<Real>({passChoice(description).periodic, !radius.empty()}, target).curvature,
                 this->lattice_.particle_mass,
                 description.rest_density,
                 this->h_,
                 this->count_,
                 scratch_} {
    scratch_.allocate();
    run();
  }

  /// The description's tissue at the rounded particles.
  std::vector<test::TissueAt> tissue() const {
    std::vector<test::TissueAt> tissue(this->count_);
    const Particles<Real>& placed = this->placed_;
    for (std::uint32_t i = 0; i < this->count_; ++i) {
      WallSample<Real> wall;
      const Real h = static_cast<Real>(this->h_);
      if (!walls_.field().sample(placed.x[i] * h, placed.y[i] * h, placed.z[i] * h, wall)) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        tissue[i].gradient[static_cast<Eigen::Index>(a)] = static_cast<double>(wall.gradient[a]);
        tissue[i].normal[static_cast<Eigen::Index>(a)] = static_cast<double>(wall.normal[a]);
      }
      tissue[i].distance = static_cast<double>(wall.distance);
    }
    return tissue;
  }
  const std::vector<Vec3>& acceleration() const { return acceleration_; }

 private:
  static test::OracleParticles withRadii(test::OracleParticles particles, const std::vector<double>& radius, double h) {
    particles.radius.clear();
    for (const double r : radius) particles.radius.push_back(r / h);
    return particles;
  }

  void run() {
    walls_.sample(this->grid_, this->sorted_, wounds_, this->count_, this->shares_, *this->executor_);
    this->passes_.density(this->grid_, this->sorted_, walls_.share(), this->count_, this->shares_, *this->executor_);
    ForceJob<Real> forces = this->passes_.forceJob();
    forces.normals = tension_.begin(this->sorted_, walls_, this->passes_, this->shares_, *this->executor_);
    this->passes_.force(this->grid_, this->sorted_, this->count_, this->shares_, *this->executor_, true, forces);
    tension_.add(this->grid_, this->sorted_, walls_, this->passes_, this->count_, this->shares_, *this->executor_);
    acceleration_ = this->vectorsOf(this->passes_.acceleration());
  }

  WallEffects<Real> walls_;
  WoundSet wounds_;
  StepScratch scratch_;
  SurfaceTension<Real> tension_;
  std::vector<Vec3> acceleration_;
};

}  // namespace bleedsim::sph
