// Surface tension without a world: a test places any particles, of any support radius, and reads the accelerations in the order
// of placing. Tissue of the description acts by its share alone.
#pragma once

#include <memory>
#include <vector>

#include "service/sph/effects/surface_tension.h"
#include "service/sph/world_setup.h"
#include "tests/support/compiled_tables.h"
#include "tests/support/tension_oracle.h"

namespace bleedsim::sph {

template <class Real>
class TensionRig {
 public:
  /// `radius` in m, at most the description's support radius, or empty. In double precision the target is the scalar twin.
  TensionRig(const WorldDescription& description, SimdTarget target, const test::OracleParticles& particles, int shares = 1,
             const std::vector<double>& radius = {})
      : description_{description},
        h_{description.supportRadius()},
        lattice_{calibrateRestLattice({description.kernel, h_}, description.spacing, description.rest_density)},
        count_{static_cast<std::uint32_t>(particles.position.size())},
        shares_{shares},
        executor_{makeExecutor(shares)},
        placed_{count_, particleFields<Real>(description), 0},
        sorted_{count_, particleFields<Real>(description), Particles<Real>::kArrays},
        grid_{count_,
              asArray(description.domain.lower / h_),
              asArray(description.domain.upper / h_),
              description.domain.periodic,
              0.0,
              shares},
        passes_{test::passesOf<Real>(description, target),
                {.set = {}, .tissue = !description.tissue.empty(), .tension = true},
                pairConstants<Real>(description, lattice_, speedOfSound(description)),
                count_,
                description.support_ratio,
                shares},
        walls_{*TissueField<Real>::create(description.tissue, {.kernel = {description.kernel, h_},
                                                               .spacing = description.spacing,
                                                               .particle_mass = lattice_.particle_mass,
                                                               .rest_density = description.rest_density}),
               wallConstants<Real>(description, lattice_, speedOfSound(description)), count_, shares},
        wounds_{description, speedOfSound(description)},
        tension_{*description.effects.surface_tension,
                 test::sweepsOf<Real>({isPeriodic(), !radius.empty()}, target),
                 lattice_.particle_mass,
                 description.rest_density,
                 h_,
                 count_} {
    for (std::uint32_t i = 0; i < count_; ++i) place(i, particles, radius);
    run();
  }

  /// As the sweeps see them, rounded to Real.
  test::OracleParticles rounded() const {
    test::OracleParticles particles;
    for (std::uint32_t i = 0; i < count_; ++i) {
      particles.position.push_back(h_ * Vec3{double(placed_.x[i]), double(placed_.y[i]), double(placed_.z[i])});
      particles.velocity.push_back({double(placed_.vx[i]), double(placed_.vy[i]), double(placed_.vz[i])});
    }
    return particles;
  }
  /// The description's tissue at the rounded particles.
  std::vector<test::TissueAt> tissue() const {
    std::vector<test::TissueAt> tissue(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      WallSample<Real> wall;
      const Real h = static_cast<Real>(h_);
      if (!walls_.field().sample(placed_.x[i] * h, placed_.y[i] * h, placed_.z[i] * h, wall)) continue;
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
  bool isPeriodic() const { return passChoice(description_).periodic; }
  static std::array<double, 3> asArray(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

  void place(std::uint32_t i, const test::OracleParticles& particles, const std::vector<double>& radius) {
    const Vec3 position = particles.position[i] / h_;
    placed_.x[i] = static_cast<Real>(position.x());
    placed_.y[i] = static_cast<Real>(position.y());
    placed_.z[i] = static_cast<Real>(position.z());
    placed_.vx[i] = static_cast<Real>(particles.velocity[i].x());
    placed_.vy[i] = static_cast<Real>(particles.velocity[i].y());
    placed_.vz[i] = static_cast<Real>(particles.velocity[i].z());
    placed_.id[i] = i;
    if (!placed_.radius.empty()) placed_.radius[i] = static_cast<Real>(radius[i] / h_);
  }

  void run() {
    Bounds<Real> bounds;
    for (std::uint32_t i = 0; i < count_; ++i) bounds.include(placed_.x[i], placed_.y[i], placed_.z[i]);
    grid_.cover(bounds);
    for (std::uint32_t i = 0; i < count_; ++i) grid_.cells()[i] = grid_.cellAt(placed_.x[i], placed_.y[i], placed_.z[i]);
    grid_.sort(count_, shares_, *executor_, [&](std::uint32_t from, std::uint32_t to) {
      sorted_.copyOne(to, placed_, from);
      passes_.pack(to, sorted_);
    });
    walls_.sample(grid_, sorted_, wounds_, count_, shares_, *executor_);
    passes_.density(grid_, sorted_, walls_.share(), count_, shares_, *executor_);
    passes_.force(grid_, sorted_, count_, shares_, *executor_, true);
    tension_.add(grid_, sorted_, walls_, passes_, count_, shares_, *executor_);
    acceleration_.resize(count_);
    for (std::uint32_t k = 0; k < count_; ++k) {
      const Real* a = passes_.acceleration() + std::size_t{k} * 4;
      acceleration_[sorted_.id[k]] = {double(a[0]), double(a[1]), double(a[2])};
    }
  }

  WorldDescription description_;
  double h_;
  RestLattice lattice_;
  std::uint32_t count_;
  int shares_;
  std::unique_ptr<Executor> executor_;
  Particles<Real> placed_, sorted_;
  CellGrid<Real> grid_;
  PairPasses<Real> passes_;
  WallEffects<Real> walls_;
  WoundSet wounds_;
  SurfaceTension<Real> tension_;
  std::vector<Vec3> acceleration_;
};

}  // namespace bleedsim::sph
