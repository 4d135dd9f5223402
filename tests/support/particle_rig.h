// Particles, grid and pair passes without a world, for the rigs of single effects: any particles, sorted and packed as a world
// does it. What a rig computes is given back in the order of placing.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/world_setup.h"
#include "tests/support/brute_force.h"
#include "tests/support/compiled_tables.h"

namespace bleedsim::test {

template <class Real>
class ParticleRig {
 public:
  /// `description` says which effects act; its blocks are not seeded. In double precision the target is the scalar twin.
  /// `factors`: of particles' own radii, as PairPasses takes them.
  ParticleRig(const sph::WorldDescription& description, sph::SimdTarget target, const sph::PairLayout& layout,
              const OracleParticles& particles, int shares, const std::optional<sph::LatticeFactors<Real>>& factors)
      : h_{description.supportRadius()},
        lattice_{sph::calibrateRestLattice(description.densityKernel(), description.spacing, description.rest_density)},
        count_{static_cast<std::uint32_t>(particles.position.size())},
        shares_{shares},
        executor_{sph::makeExecutor(shares)},
        placed_{count_, sph::particleFields<Real>(description), 0},
        sorted_{count_, sph::particleFields<Real>(description), sph::Particles<Real>::kArrays},
        grid_{count_,
              asArray(description.domain.lower / h_),
              asArray(description.domain.upper / h_),
              description.domain.periodic,
              0.0,
              shares,
              sph::radiusBounds(description).largest},
        passes_{passesOf<Real>(description, target),
                layout,
                sph::pairConstants<Real>(description, lattice_, sph::speedOfSound(description)),
                count_,
                description.support_ratio * sph::radiusBounds(description).largest,
                shares,
                factors} {
    for (std::uint32_t i = 0; i < count_; ++i) place(i, particles);
    sort();
  }

  /// The particles as the passes see them, rounded to Real: what the oracle must be given.
  OracleParticles rounded() const {
    OracleParticles particles;
    for (std::uint32_t i = 0; i < count_; ++i) {
      particles.position.push_back(h_ * sph::Vec3{double(placed_.x[i]), double(placed_.y[i]), double(placed_.z[i])});
      particles.velocity.push_back({double(placed_.vx[i]), double(placed_.vy[i]), double(placed_.vz[i])});
      if (!placed_.inverse_viscosity.empty()) particles.viscosity.push_back(1.0 / double(placed_.inverse_viscosity[i]));
      if (!placed_.platelet.empty()) particles.platelet.push_back(double(placed_.platelet[i]));
      if (!placed_.radius.empty()) particles.radius.push_back(double(placed_.radius[i]));
    }
    return particles;
  }

 protected:
  /// visit(k, i): the sorted particle k was placed as i.
  template <class Visit>
  void forEachPlaced(const Visit& visit) const {
    for (std::uint32_t k = 0; k < count_; ++k) visit(k, sorted_.id[k]);
  }
  /// In the order of placing, of an array with four numbers for each sorted particle.
  std::vector<sph::Vec3> vectorsOf(const Real* sorted) const {
    std::vector<sph::Vec3> vectors(count_);
    forEachPlaced([&](std::uint32_t k, std::uint32_t i) {
      const Real* v = sorted + std::size_t{k} * 4;
      vectors[i] = {double(v[0]), double(v[1]), double(v[2])};
    });
    return vectors;
  }

  double h_;
  sph::RestLattice lattice_;
  std::uint32_t count_;
  int shares_;
  std::unique_ptr<sph::Executor> executor_;
  sph::Particles<Real> placed_, sorted_;
  sph::CellGrid<Real> grid_;
  sph::PairPasses<Real> passes_;

 private:
  static std::array<double, 3> asArray(const sph::Vec3& v) { return {v.x(), v.y(), v.z()}; }

  void place(std::uint32_t i, const OracleParticles& particles) {
    const sph::Vec3 position = particles.position[i] / h_;
    placed_.x[i] = static_cast<Real>(position.x());
    placed_.y[i] = static_cast<Real>(position.y());
    placed_.z[i] = static_cast<Real>(position.z());
    placed_.vx[i] = static_cast<Real>(particles.velocity[i].x());
    placed_.vy[i] = static_cast<Real>(particles.velocity[i].y());
    placed_.vz[i] = static_cast<Real>(particles.velocity[i].z());
    placed_.id[i] = i;
    if (!placed_.inverse_viscosity.empty()) placed_.inverse_viscosity[i] = static_cast<Real>(1.0 / particles.viscosity[i]);
    if (!placed_.platelet.empty()) placed_.platelet[i] = static_cast<Real>(particles.platelet[i]);
    if (!placed_.radius.empty()) placed_.radius[i] = static_cast<Real>(particles.radius[i]);
  }

  void sort() {
    sph::Bounds<Real> bounds;
    for (std::uint32_t i = 0; i < count_; ++i) bounds.include(placed_.x[i], placed_.y[i], placed_.z[i]);
    Real reach = Real(1);
    if (!placed_.radius.empty())
      reach = std::max(reach, *std::max_element(placed_.radius.data(), placed_.radius.data() + count_));
    passes_.setReach(reach);
    grid_.cover(bounds, reach);
    for (std::uint32_t i = 0; i < count_; ++i) grid_.cells()[i] = grid_.cellAt(placed_.x[i], placed_.y[i], placed_.z[i]);
    grid_.sort(count_, shares_, *executor_, [&](std::uint32_t from, std::uint32_t to) {
      sorted_.copyOne(to, placed_, from);
      passes_.pack(to, 1, sorted_);
    });
  }
};

}  // namespace bleedsim::test
