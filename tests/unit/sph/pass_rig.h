// Pair passes without a world: a test places any particles and reads the fields, both in the order of placing.
#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/sph/effects/literal_forces.h"
#include "service/sph/effects/platelets.h"
#include "service/sph/seeding.h"
#include "tests/support/particle_rig.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {

template <class Real>
class PassRig : public test::ParticleRig<Real> {
 public:
  PassRig(const WorldDescription& description, SimdTarget target, const test::OracleParticles& particles, int shares = 1)
      : test::ParticleRig<Real>{description, target, layoutOf(description),
                                particles,   shares, latticeFactors<Real>(description)} {
    if (description.model == Model::literal) {
      literal_.emplace(description, this->lattice_, speedOfSound(description), viscosityVaries(description), target);
    }
    if (description.effects.platelets && description.model == Model::sound) {
      platelets_.emplace(*description.effects.platelets, test::sweepsOf<Real>(sweepChoice(description), target).platelets,
                         laplacianPrefactor(description, this->lattice_), description.spacing, description.rest_density,
                         TissueField<Real>{});
    }
    run();
  }

  const std::vector<double>& density() const { return density_; }
  const std::vector<Vec3>& acceleration() const { return acceleration_; }
  const std::vector<double>& plateletRate() const { return platelet_rate_; }
  std::uint64_t overflowed() const { return overflowed_; }

  /// Once more, with the sound model's forces close behind the densities. Not with periodic sides. Without `keep` the room of the
  /// lists is used again and again, and the platelets' walk, which needs them, does not follow.
  void runAtOnce(bool keep = true) {
    double force_part = 0.0;
    PairPasses<Real>& passes = this->passes_;
    std::fill_n(passes.acceleration(), std::size_t{this->count_} * 4, Real(0));
    overflowed_ = passes.densityAndSweep(this->grid_, this->sorted_, nullptr, this->count_, this->shares_, *this->executor_,
                                         passes.forceFunction(true), forceJob(), keep, force_part);
    if (keep) diffuse();
    EXPECT_GT(force_part, 0.0);
    EXPECT_LT(force_part, 1.0);
    read();
  }

  /// The product of the implicit viscosity with the velocities, m/s^2, and its mean diagonal in `diagonal`.
  std::vector<Vec3> viscousProduct(SimdTarget target, const WorldDescription& description, std::vector<double>& diagonal) {
    const auto& sweeps = test::sweepsOf<Real>(sweepChoice(description), target);
    ViscousProductJob<Real> job;
    job.scale = Real(5) * pairConstants<Real>(description, this->lattice_, speedOfSound(description)).viscosity_scale;
    std::vector<Real> product(std::size_t{this->count_} * 4);
    job.product = product.data();
    const auto function = viscosityVaries(description) ? sweeps.viscous_product : sweeps.uniform_viscous_product;
    this->passes_.sweep(this->grid_, this->sorted_, this->count_, this->shares_, *this->executor_, function, job);
    diagonal.resize(this->count_);
    this->forEachPlaced([&](std::uint32_t k, std::uint32_t i) { diagonal[i] = double(product[std::size_t{k} * 4 + 3]); });
    return this->vectorsOf(product.data());
  }

 private:
  static PairLayout layoutOf(const WorldDescription& d) {
    if (d.model == Model::literal) return pairLayout(d);
    PairLayout layout = pairLayout(d);
    layout.tissue = false;
    return layout;
  }

  void run() {
    PairPasses<Real>& passes = this->passes_;
    overflowed_ = passes.density(this->grid_, this->sorted_, nullptr, this->count_, this->shares_, *this->executor_);
    if (literal_) {
      literal_->thicken(this->sorted_, passes, this->count_, this->shares_, *this->executor_);
      literal_->add(this->grid_, this->sorted_, passes, this->count_, this->shares_, *this->executor_);
    } else {
      passes.force(this->grid_, this->sorted_, this->count_, this->shares_, *this->executor_, true, forceJob());
      diffuse();
    }
    read();
  }

  /// With room for the normals that sets with tension write; nobody reads them.
  ForceJob<Real> forceJob() {
    ForceJob<Real> job = this->passes_.forceJob();
    normal_.resize(std::size_t{this->count_} * 4);
    job.normals = {this->sorted_.driver.data(), Real(1), Real(1), this->passes_.record(0), normal_.data()};
    return job;
  }
  void diffuse() {
    if (platelets_) platelets_->diffuse(this->grid_, this->sorted_, this->passes_, this->count_, this->shares_, *this->executor_);
  }

  void read() {
    const PairPasses<Real>& passes = this->passes_;
    acceleration_ = this->vectorsOf(passes.acceleration());
    density_.resize(this->count_);
    platelet_rate_.resize(this->count_);
    this->forEachPlaced([&](std::uint32_t k, std::uint32_t i) {
      density_[i] = double(passes.density()[k]);
      platelet_rate_[i] = double(passes.acceleration()[std::size_t{k} * 4 + 3]);
    });
  }

  std::optional<LiteralForces<Real>> literal_;
  std::optional<Clotting<Real>> platelets_;
  std::vector<Real> normal_;
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
  if (set.tension) name += "Tension";
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
  if (set.tension) description.effects.surface_tension.emplace();
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
