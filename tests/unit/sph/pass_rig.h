// Grid and pair passes without a world: a test places any particles and reads the fields, both in the order of placing.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/sph/effects/literal_forces.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/seeding.h"
#include "service/sph/world_setup.h"
#include "tests/support/brute_force.h"
#include "tests/support/compiled_tables.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {

template <class Real>
class PassRig {
 public:
  /// `description` says which effects act; its blocks are not seeded. In double precision the target is the scalar twin.
  PassRig(const WorldDescription& description, SimdTarget target, const test::OracleParticles& particles, int shares = 1)
      : h_{description.supportRadius()},
        capacity_{static_cast<std::uint32_t>(particles.position.size())},
        shares_{shares},
        executor_{makeExecutor(shares)},
        placed_{capacity_, particleFields<Real>(description), 0},
        sorted_{capacity_, particleFields<Real>(description), Particles<Real>::kArrays},
        grid_{capacity_,
              asArray(description.domain.lower / h_),
              asArray(description.domain.upper / h_),
              description.domain.periodic,
              0.0,
              shares,
              radiusBounds(description).largest},
        passes_{test::passesOf<Real>(description, target),
                layoutOf(description),
                pairConstants<Real>(description, latticeOf(description), speedOfSound(description)),
                capacity_,
                description.support_ratio * radiusBounds(description).largest,
                shares,
                latticeFactors<Real>(description)} {
    for (std::uint32_t i = 0; i < capacity_; ++i) place(i, particles);
    if (description.model == Model::literal) {
      literal_.emplace(description, latticeOf(description), speedOfSound(description), viscosityVaries(description), target);
    }
    run();
  }

  /// The particles as the passes see them, rounded to Real: what the oracle must be given.
  test::OracleParticles rounded() const {
    test::OracleParticles particles;
    for (std::uint32_t i = 0; i < capacity_; ++i) {
      particles.position.push_back(h_ * Vec3{double(placed_.x[i]), double(placed_.y[i]), double(placed_.z[i])});
      particles.velocity.push_back({double(placed_.vx[i]), double(placed_.vy[i]), double(placed_.vz[i])});
      if (!placed_.inverse_viscosity.empty()) particles.viscosity.push_back(1.0 / double(placed_.inverse_viscosity[i]));
      if (!placed_.platelet.empty()) particles.platelet.push_back(double(placed_.platelet[i]));
      if (!placed_.radius.empty()) particles.radius.push_back(double(placed_.radius[i]));
    }
    return particles;
  }
  const std::vector<double>& density() const { return density_; }
  const std::vector<Vec3>& acceleration() const { return acceleration_; }
  const std::vector<double>& plateletRate() const { return platelet_rate_; }
  std::uint64_t overflowed() const { return overflowed_; }

  /// The product of the implicit viscosity with the velocities, m/s^2, and its mean diagonal in `diagonal`.
  std::vector<Vec3> viscousProduct(SimdTarget target, const WorldDescription& description, std::vector<double>& diagonal) {
    const auto& sweeps = test::sweepsOf<Real>(sweepChoice(description), target);
    ViscousProductJob<Real> job;
    job.scale = Real(5) * pairConstants<Real>(description, latticeOf(description), speedOfSound(description)).viscosity_scale;
    std::vector<Real> product(std::size_t{capacity_} * 4);
    job.product = product.data();
    const auto function = viscosityVaries(description) ? sweeps.viscous_product : sweeps.uniform_viscous_product;
    passes_.sweep(grid_, sorted_, capacity_, shares_, *executor_, function, job);
    std::vector<Vec3> result(capacity_);
    diagonal.resize(capacity_);
    for (std::uint32_t k = 0; k < capacity_; ++k) {
      const Real* a = &product[std::size_t{k} * 4];
      result[sorted_.id[k]] = {double(a[0]), double(a[1]), double(a[2])};
      diagonal[sorted_.id[k]] = static_cast<double>(a[3]);
    }
    return result;
  }

 private:
  static std::array<double, 3> asArray(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
  static RestLattice latticeOf(const WorldDescription& d) {
    return calibrateRestLattice(d.densityKernel(), d.spacing, d.rest_density);
  }
  static PairLayout layoutOf(const WorldDescription& d) {
    if (d.model == Model::literal) return pairLayout(d);
    return {.set = pairSet(d)};
  }

  void place(std::uint32_t i, const test::OracleParticles& particles) {
    const Vec3 position = particles.position[i] / h_;
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

  void run() {
    Bounds<Real> bounds;
    for (std::uint32_t i = 0; i < capacity_; ++i) bounds.include(placed_.x[i], placed_.y[i], placed_.z[i]);
    Real reach = Real(1);
    if (!placed_.radius.empty())
      reach = std::max(reach, *std::max_element(placed_.radius.data(), placed_.radius.data() + capacity_));
    passes_.setReach(reach);
    grid_.cover(bounds, reach);
    for (std::uint32_t i = 0; i < capacity_; ++i) grid_.cells()[i] = grid_.cellAt(placed_.x[i], placed_.y[i], placed_.z[i]);
    const std::uint32_t count = grid_.sort(capacity_, shares_, *executor_, [&](std::uint32_t from, std::uint32_t to) {
      sorted_.copyOne(to, placed_, from);
      passes_.pack(to, sorted_);
    });
    overflowed_ = passes_.density(grid_, sorted_, nullptr, count, shares_, *executor_);
    if (literal_) {
      literal_->add(grid_, sorted_, passes_, count, shares_, *executor_);
    } else {
      passes_.force(grid_, sorted_, count, shares_, *executor_, true);
    }
    density_.resize(capacity_);
    acceleration_.resize(capacity_);
    platelet_rate_.resize(capacity_);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Real* a = passes_.acceleration() + std::size_t{k} * 4;
      density_[sorted_.id[k]] = static_cast<double>(passes_.density()[k]);
      acceleration_[sorted_.id[k]] = {double(a[0]), double(a[1]), double(a[2])};
      platelet_rate_[sorted_.id[k]] = static_cast<double>(a[3]);
    }
  }

  double h_;
  std::uint32_t capacity_;
  int shares_;
  std::unique_ptr<Executor> executor_;
  Particles<Real> placed_, sorted_;
  CellGrid<Real> grid_;
  PairPasses<Real> passes_;
  std::optional<LiteralForces<Real>> literal_;
  std::uint64_t overflowed_ = 0;
  std::vector<double> density_;
  std::vector<Vec3> acceleration_;
  std::vector<double> platelet_rate_;
};

/// For the names of test cases.
inline std::string nameOf(PairSet set) {
  std::string name;
  if (set.pressure != PressureTerm::none) name += set.pressure == PressureTerm::symmetric ? "SymmetricPressure" : "Pressure";
  if (set.viscosity != ViscosityTerm::none)
    name += set.viscosity == ViscosityTerm::uniform ? "UniformViscosity" : "HarmonicViscosity";
  if (set.platelets) name += "Platelets";
  if (set.repulsion) name += "Repulsion";
  if (set.core_radius) name += "CoreRadius";
  return name;
}

/// Every set of pair effects that is compiled.
inline std::vector<PairSet> allPairSets() {
  std::vector<PairSet> sets;
  for (std::size_t k = 0; k < PairSet::kCount; ++k) {
    const PairSet set = PairSet::at(k);
    if (!set.empty() && set.legal()) sets.push_back(set);
  }
  return sets;
}

/// Turns the description's effects into those of `set`; it must have a block.
inline WorldDescription withPairSet(WorldDescription description, PairSet set) {
  description.effects.pressure.reset();
  description.effects.viscosity.reset();
  if (set.pressure != PressureTerm::none) description.effects.pressure.emplace();
  if (set.pressure == PressureTerm::symmetric) description.effects.pressure->form = PressureForm::symmetric;
  if (set.platelets) description.effects.platelets.emplace();
  if (set.repulsion) description.effects.repulsion.emplace();
  if (set.core_radius) description.effects.core_radius.emplace();
  if (set.viscosity != ViscosityTerm::none) description.effects.viscosity.emplace();
  if (set.viscosity == ViscosityTerm::harmonic) description.fluid_blocks.at(0).viscosity = 0.02;
  return description;
}

/// The particles of the description's blocks with random velocities up to 0.3 m/s along each axis, viscosities of 1..21 mPa s and
/// support radii of 0.9..1.3 h.
inline test::OracleParticles stirred(const WorldDescription& description) {
  test::OracleParticles particles;
  JitterSource random{42};
  for (const FluidBlock& block : description.fluid_blocks) {
    seedBlock(block, description.spacing, random, [&](Vec3 position) {
      for (Eigen::Index a = 0; a < 3; ++a) {
        const double side = description.domain.upper[a] - description.domain.lower[a];
        if (description.domain.periodic[static_cast<std::size_t>(a)])
          position[a] -= side * std::floor((position[a] - description.domain.lower[a]) / side);
      }
      particles.position.push_back(position);
    });
  }
  for (std::size_t i = 0; i < particles.position.size(); ++i) {
    const double x = random.next();
    const double y = random.next();
    particles.velocity.push_back(0.3 * Vec3{x, y, random.next()});
    particles.viscosity.push_back(0.011 + 0.01 * random.next());
    particles.platelet.push_back(0.5 + 0.5 * random.next());
  }
  for (std::size_t i = 0; i < particles.position.size(); ++i) particles.radius.push_back(1.1 + 0.2 * random.next());
  return particles;
}

inline double largestNorm(std::span<const Vec3> field) {
  double largest = 0.0;
  for (const Vec3& v : field) largest = std::max(largest, v.norm());
  return largest;
}
inline double largestDifference(std::span<const Vec3> a, std::span<const Vec3> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}
/// Relative to b.
inline double largestRelativeDifference(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]) / b[i]);
  return largest;
}

}  // namespace bleedsim::sph
