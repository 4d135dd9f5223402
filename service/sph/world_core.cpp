#include "service/sph/world_core.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "service/sph/flush_to_zero.h"
#include "service/sph/integrate/layer_lock.h"
#include "service/sph/world_setup.h"

namespace bleedsim::sph {
namespace {

// The implicit solve stays on until the explicit limit has left the others this far behind: it must not flicker.
constexpr double kImplicitBand = 1.2;

// How often particles on one spot are looked for. They come of bad seeding and of corners, so a few steps more do no harm.
constexpr std::uint64_t kCoincidenceSteps = 32;

constexpr double kAnyTime = std::numeric_limits<double>::infinity();  // s

// Below this a second thread costs more than it brings.
constexpr std::uint32_t kParticlesForThreads = 2000;

template <class Real>
std::array<Real, 3> inSupportRadii(const Vec3& v, double h) {
  return {static_cast<Real>(v.x() / h), static_cast<Real>(v.y() / h), static_cast<Real>(v.z() / h)};
}

// Pairs that are in contact when repulsion is switched on would burst apart: contacts grow from nothing over this time, in dx/c0.
constexpr double kContactGrowth = 200.0;

std::array<double, 3> asArray(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

template <class Real>
WorldCore<Real>::WorldCore(const WorldDescription& description, const WorldOptions& options, SimdTarget target,
                           const WorldTables<Real>& tables, const RestLattice& lattice, TissueField<Real> tissue)
    : description_{description},
      target_{target},
      speed_of_sound_{options.speed_of_sound.value_or(sph::speedOfSound(description))},
      lattice_{lattice},
      h_{description.supportRadius()},
      domain_{inSupportRadii<Real>(description.domain.lower, h_), inSupportRadii<Real>(description.domain.upper, h_),
              description.domain.periodic},
      caps_{static_cast<Real>(2.0 * speed_of_sound_),
            static_cast<Real>(kAccelerationBound * speed_of_sound_ * speed_of_sound_ / description.spacing)},
      limits_{timeStepLimits(description, speed_of_sound_)},
      executor_{makeExecutor(options.threads)},
      particles_{description.capacity, particleFields<Real>(description), 0},
      sorted_{description.capacity, particleFields<Real>(description), Particles<Real>::kArrays},
      grid_{description.capacity,
            asArray(description.domain.lower / h_),
            asArray(description.domain.upper / h_),
            description.domain.periodic,
            kThroatMargin / description.support_ratio,
            options.threads,
            radiusBounds(description).largest},
      coincidence_{1.0 / description.support_ratio, description.planar, domain_, options.threads},
      passes_{tables.passes,
              pairLayout(description),
              pairConstants<Real>(description, lattice, speed_of_sound_),
              description.capacity,
              description.support_ratio * radiusBounds(description).largest,
              options.threads,
              latticeFactors<Real>(description)},
      walls_{std::move(tissue), wallConstants<Real>(description, lattice, speed_of_sound_), description.capacity,
             options.threads},
      wounds_{description, speed_of_sound_},
      drift_results_(static_cast<std::size_t>(options.threads)),
      kick_results_(static_cast<std::size_t>(options.threads)) {
  if (options.complete_search) {
    grid_.useOneCell();
    coincidence_.useOneCell(description.capacity);
  }
  if (description.effects.gravity) {
    const Vec3& g = description.effects.gravity->acceleration;
    gravity_ = {static_cast<Real>(g.x()), static_cast<Real>(g.y()), static_cast<Real>(g.z())};
  }
  if (description.planar) gravity_[2] = Real(0);
  const EffectSettings& effects = description.effects;
  if (description.model == Model::literal) {
    opening_ = 1.0;
    literal_.emplace(description, lattice, speed_of_sound_, viscosityVaries(description), target);
    if (effects.core_radius) literal_radius_.emplace(description, lattice, options.threads);
  } else {
    if (effects.core_radius) core_radius_.emplace(*effects.core_radius, description.rest_density, options.threads);
    if (shearRateNeeded(effects)) shear_rate_.emplace(description, lattice, tables.sweeps.shear_rate, scratch_);
    if (viscosityChanges(effects)) rheology_.emplace(effects, options.threads);
    thins_ = viscosityThins(effects);
    if (effects.platelets) {
      clotting_.emplace(*effects.platelets, tables.sweeps.platelets, laplacianPrefactor(description, lattice),
                        description.spacing, description.rest_density, walls_.field());
    }
  }
  if (mayNeedImplicitViscosity(description, speed_of_sound_)) {
    const ViscositySettings& viscosity = *description.effects.viscosity;
    const bool varies = viscosityVaries(description);
    const auto product = varies ? tables.sweeps.viscous_product : tables.sweeps.uniform_viscous_product;
    implicit_viscosity_.emplace(ImplicitSettings{viscosity.solve_tolerance, viscosity.max_iterations}, product,
                                Real(5) * pairConstants<Real>(description, lattice, speed_of_sound_).viscosity_scale,
                                description.capacity, scratch_);
  }
  if (description.effects.applied_force) {
    applied_force_.emplace(description.effects.applied_force->max_sources, lattice.particle_mass, h_, description.domain);
  }
  if (description.effects.surface_tension && description.model == Model::sound) {
    surface_tension_.emplace(*description.effects.surface_tension, tables.sweeps.curvature, lattice.particle_mass,
                             description.rest_density, h_, description.capacity, scratch_);
  }
  scratch_.allocate();
}

template <class Real>
Status WorldCore<Real>::populate() {
  JitterSource jitter{description_.seed};
  for (const FluidBlock& block : description_.fluid_blocks) {
    const double layer = block.lower.z() + 0.5 * description_.spacing;  // of a planar world: jitter leaves it
    seedBlock(block, description_.spacing, jitter, [&](const Vec3& position) {
      const std::uint32_t i = count_++;
      particles_.x[i] = static_cast<Real>(position.x() / h_);
      particles_.y[i] = static_cast<Real>(position.y() / h_);
      particles_.z[i] = static_cast<Real>((description_.planar ? layer : position.z()) / h_);
      particles_.vx[i] = static_cast<Real>(block.velocity.x());
      particles_.vy[i] = static_cast<Real>(block.velocity.y());
      particles_.vz[i] = static_cast<Real>(block.velocity.z());
      particles_.id[i] = next_id_++;
      makeBlood(i, block.viscosity, block.platelet);
    });
  }
  injected_ = count_;
  for (const WoundDescription& wound : description_.wounds) {
    const Result<std::uint32_t> added = wounds_.add(wound);
    if (!added) return {added.status().code(), "wound '" + wound.name + "': " + added.status().message()};
  }
  const FlushToZero scope;
  clock_.start();
  emit(0.0);
  chooseShares();
  // Implicit viscosity is no part of the accelerations, and these are the first ones.
  solving_viscosity_ = mustSolveViscosity(acousticLimit(limits_.spacing, limits_.speed_of_sound));
  holdStill();
  computeAccelerations();
  faulted_ = !closeKick(0.0);
  if (faulted_) return {StatusCode::internal, "the scene's first accelerations are not finite"};
  finishStep(0.0);
  chooseTimeStep(kAnyTime);
  return {};
}

template <class Real>
Status WorldCore<Real>::step(double dt_limit) {
  if (!(dt_limit > 0.0)) return {StatusCode::invalid_argument, "the step's limit must be a time greater than 0 s"};
  if (faulted_) return {StatusCode::internal, "the world is faulted: its state stopped being finite; reset it"};
  const FlushToZero scope;
  double stable = next_dt_;
  double dt = std::min(stable, dt_limit);
  clock_.start();
  mark();
  if (const Trouble trouble = attempt(dt); trouble != Trouble::none) [[unlikely]] {
    dt = recover(dt, trouble);
    stable = dt;
    if (faulted_) return {StatusCode::internal, "no step gives a finite state; the world is faulted and stays as it was before"};
  }
  finishStep(dt);
  chooseTimeStep(stable);
  last_dt_ = dt;
  time_ += dt;
  ++steps_;
  clock_.lap(Stage::integrate);
  return {};
}

/// A step of `dt` up to where it shows whether it holds; what comes after only takes and cannot be taken back.
template <class Real>
Trouble WorldCore<Real>::attempt(double dt) {
  clotting_due_ = clotting_ && (steps_ >= clotting_step_ || clotting_time_ + dt >= clotting_->longestStep());
  emit(dt);
  clock_.lap(Stage::emit);
  chooseShares();
  move(dt);
  computeAccelerations();
  const bool finite = closeKick(dt);
  return troubleOf(finite, dt, finite ? allowedTimeStep(solving_viscosity_, kAnyTime) : 0.0);
}

template <class Real>
void WorldCore<Real>::chooseShares() {
  shares_ = count_ < kParticlesForThreads ? 1 : executor_->threads();
}

template <class Real>
void WorldCore<Real>::emit(double dt) {
  const InletStep step = wounds_.advance(dt, [&](const InletSpawn& spawn) {
    if (count_ >= description_.capacity) return false;
    const std::uint32_t i = count_++;
    ++unseen_;
    particles_.x[i] = static_cast<Real>(spawn.state.position.x() / h_);
    particles_.y[i] = static_cast<Real>(spawn.state.position.y() / h_);
    particles_.z[i] = static_cast<Real>(spawn.state.position.z() / h_);
    particles_.vx[i] = static_cast<Real>(spawn.state.velocity.x());
    particles_.vy[i] = static_cast<Real>(spawn.state.velocity.y());
    particles_.vz[i] = static_cast<Real>(spawn.state.velocity.z());
    particles_.id[i] = next_id_++;
    particles_.driver[i] = spawn.tag;
    makeBlood(i, std::nullopt, std::nullopt);
    std::fill_n(passes_.acceleration() + std::size_t{i} * 4, 4, Real(0));
    return true;
  });
  unseen_ -= static_cast<std::uint32_t>(step.emitted);
  injected_ += step.emitted;
}

/// The new particle's own share of the fields that only some scenes have.
template <class Real>
void WorldCore<Real>::makeBlood(std::uint32_t i, std::optional<double> viscosity, std::optional<double> platelet) {
  const EffectSettings& effects = description_.effects;
  if (!particles_.inverse_viscosity.empty()) {
    double acting = viscosity.value_or(effects.viscosity->viscosity);
    if (clotting_) { acting = thickened(acting, effects.platelets->clot_viscosity, platelet.value_or(effects.platelets->fresh)); }
    particles_.inverse_viscosity[i] = static_cast<Real>(1.0 / acting);
  }
  if (!particles_.own_viscosity.empty()) particles_.own_viscosity[i] = static_cast<Real>(viscosity.value_or(0.0));
  if (!particles_.platelet.empty()) particles_.platelet[i] = static_cast<Real>(platelet.value_or(effects.platelets->fresh));
  if (!particles_.radius.empty()) particles_.radius[i] = Real(1);
}

template <class Real>
void WorldCore<Real>::move(double dt) {
  const Real half_kick = static_cast<Real>(opening_ * dt);
  executor_->run(shares_, [&](int share) {
    Drift<Real> drift{particles_,
                      passes_.formerAcceleration(),
                      passes_.acceleration(),
                      half_kick,
                      static_cast<Real>(dt / h_),
                      h_,
                      domain_,
                      wounds_,
                      grid_.cells()};
    drift_results_[static_cast<std::size_t>(share)] = drift.run(ShareRange{count_, share, shares_});
  });
  Bounds<Real> bounds;
  for (int share = 0; share < shares_; ++share) {
    const DriftResult<Real>& result = drift_results_[static_cast<std::size_t>(share)];
    bounds.merge(result.bounds);
    counter(Counter::left_domain) += result.left_domain;
    removed_ += result.left_domain;
  }
  clock_.lap(Stage::move);
  findNeighbors(bounds, half_kick);
}

/// In place of move(), where neighbours are wanted and no motion.
template <class Real>
void WorldCore<Real>::holdStill() {
  Bounds<Real> bounds;
  for (std::uint32_t i = 0; i < count_; ++i) {
    Real* position = passes_.formerAcceleration() + std::size_t{i} * 4;
    position[0] = particles_.x[i];
    position[1] = particles_.y[i];
    position[2] = particles_.z[i];
    bounds.include(position[0], position[1], position[2]);
    grid_.cells()[i] = 0;
  }
  findNeighbors(bounds, Real(0));
}

/// Sorts the particles by the cells that they have moved to, and gives them the opening kick on the way; none for `half_kick` 0.
template <class Real>
void WorldCore<Real>::findNeighbors(const Bounds<Real>& bounds, Real half_kick) {
  const Real* moved = passes_.formerAcceleration();
  const Real* acceleration = passes_.acceleration();
  grid_.cover(bounds, passes_.reach());
  executor_->run(shares_, [&](int share) {
    const ShareRange range{count_, share, shares_};
    std::uint32_t* cells = grid_.cells();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      if (cells[i] != CellGrid<Real>::kRemoved)
        cells[i] = grid_.cellAt(moved[std::size_t{i} * 4], moved[std::size_t{i} * 4 + 1], moved[std::size_t{i} * 4 + 2]);
    }
  });
  count_ = grid_.sortRuns(count_, shares_, *executor_, [&](std::uint32_t from, std::uint32_t to, std::uint32_t length) {
    sorted_.copyBody(to, particles_, from, length);
    copyPlaces(sorted_, to, moved + std::size_t{from} * 4, length);
    kick(sorted_, to, particles_, from, length, acceleration, half_kick, wounds_);
    passes_.pack(to, length, sorted_);
  });
  particles_.swap(sorted_);
  clock_.lap(Stage::neighbors);
}

/// Densities with forces close behind, where nothing has to come between them; whether it did.
template <class Real>
template <class Job>
bool WorldCore<Real>::passPairsAtOnce(void (*forces)(const Job&), const Job& job) {
  const auto& periodic = description_.domain.periodic;
  if (forces == nullptr || periodic[0] || periodic[1] || periodic[2]) return false;
  const bool keep = surface_tension_ || solving_viscosity_ || (clotting_ && clotting_due_);
  double force_part = 0.0;
  counter(Counter::neighbor_overflow) +=
      passes_.densityAndSweep(grid_, particles_, walls_.share(), count_, shares_, *executor_, forces, job, keep, force_part);
  clock_.lap(Stage::density, Stage::force, force_part);
  return true;
}

/// Viscosities by shear rate and platelets, and the limit of the time step that comes of them.
template <class Real>
void WorldCore<Real>::changeBlood() {
  if (shear_rate_) shear_rate_->update(grid_, particles_, walls_, passes_, count_, shares_, *executor_);
  if (!rheology_) return;
  const double largest = rheology_->update(particles_, passes_, shearRates(), count_, shares_, *executor_);
  if (largest > 0.0) limits_.viscous = diffusionLimit(description_, largest / description_.rest_density);
}

template <class Real>
void WorldCore<Real>::computeAccelerations() {
  passes_.exchangeAccelerations();
  walls_.sample(grid_, particles_, wounds_, count_, shares_, *executor_);
  clock_.lap(Stage::tissue);
  const double growth_time = kContactGrowth * description_.spacing / speed_of_sound_;
  passes_.setContactGrowth(static_cast<Real>(std::min(1.0, (time_ - repulsion_start_) / growth_time)));
  if (literal_) literal_->thicken(particles_, passes_, count_, shares_, *executor_);
  const bool blood_changes = (shear_rate_ || rheology_) && (thins_ || clotting_due_);
  const bool viscous = !solving_viscosity_;
  ForceJob<Real> forces = passes_.forceJob();
  if (surface_tension_) forces.normals = surface_tension_->begin(particles_, walls_, passes_, shares_, *executor_);
  const bool both = literal_ ? passPairsAtOnce(literal_->function(), literal_->job(passes_))
                             : !blood_changes && passPairsAtOnce(passes_.forceFunction(viscous), forces);
  if (!both) {
    counter(Counter::neighbor_overflow) += passes_.density(grid_, particles_, walls_.share(), count_, shares_, *executor_);
    clock_.lap(Stage::density);
    if (blood_changes) changeBlood();
    if (literal_) {
      literal_->add(grid_, particles_, passes_, count_, shares_, *executor_);
    } else {
      passes_.force(grid_, particles_, count_, shares_, *executor_, viscous, forces);
    }
  }
  if (clotting_ && clotting_due_) clotting_->diffuse(grid_, particles_, passes_, count_, shares_, *executor_);
  if (surface_tension_) surface_tension_->add(grid_, particles_, walls_, passes_, count_, shares_, *executor_);
  clock_.lap(Stage::force);
  if (solving_viscosity_) implicit_viscosity_->clearDrag(count_);
  walls_.addForces(particles_, passes_, shares_, *executor_, solving_viscosity_ ? implicit_viscosity_->drag() : nullptr);
  if (applied_force_ && !applied_force_->empty()) {
    const AppliedForceEvents events = applied_force_->add(time_, grid_, particles_, passes_.acceleration());
    counter(Counter::force_expired) += events.expired;
    counter(Counter::force_without_fluid) += events.without_fluid;
  }
  if (description_.planar) lockLayer(passes_.acceleration(), count_, shares_, *executor_);
  clock_.lap(Stage::body);
}

/// The closing kick and, where it is solved, viscosity. Whether all of it is finite.
template <class Real>
bool WorldCore<Real>::closeKick(double dt) {
  const auto kick = guarded_ ? guardedKick<Real> : closingKick<Real>;
  executor_->run(shares_, [&](int share) {
    kick_results_[static_cast<std::size_t>(share)] =
        kick(particles_, passes_.acceleration(), gravity_, static_cast<Real>((1.0 - opening_) * dt), caps_,
             ShareRange{count_, share, shares_});
  });
  KickResult<Real>& total = kick_results_[0];
  for (int share = 1; share < shares_; ++share) total.merge(kick_results_[static_cast<std::size_t>(share)]);
  if (!total.finite || (solving_viscosity_ && dt > 0.0 && !solveViscosity(dt))) return false;
  max_speed_ = std::sqrt(static_cast<double>(total.max_speed2));
  return true;
}

template <class Real>
void WorldCore<Real>::finishStep(double dt) {
  if (literal_) literal_->diffuse(particles_, passes_, static_cast<Real>(dt), count_, shares_, *executor_);
  if (clotting_) clotting_time_ += dt;
  if (clotting_ && clotting_due_) {
    clotting_->advance(particles_, passes_, shearRates(), walls_, grid_, static_cast<Real>(clotting_time_), count_, shares_,
                       *executor_);
    clotting_time_ = 0.0;
    clotting_step_ = steps_ + kClottingSteps;
  }
  if (core_radius_ && dt > 0.0) {
    passes_.setReach(core_radius_->update(particles_, passes_.density(), count_, shares_, *executor_));
  }
  if (literal_radius_ && dt > 0.0) {
    passes_.setReach(literal_radius_->update(particles_, passes_.density(), count_, shares_, *executor_));
  }
  counter(Counter::tissue_projected) += walls_.project(particles_, shares_, *executor_);
  if (!literal_ && steps_ % kCoincidenceSteps == 0) {
    counter(Counter::coincident_parted) += coincidence_.part(grid_, particles_, count_, shares_, *executor_);
  }
  counter(Counter::speed_clamped) += kick_results_[0].speed_clamped;
  counter(Counter::acceleration_clamped) += kick_results_[0].acceleration_clamped;
}

/// Whether the velocities are finite still. The ladder's last attempt goes without: the solution may be what is not.
template <class Real>
bool WorldCore<Real>::solveViscosity(double dt) {
  if (guarded_) {
    viscosity_iterations_ = 0;
    ++counter(Counter::viscosity_unsolved);
    return true;
  }
  const SolveOutcome outcome = implicit_viscosity_->solve(dt, grid_, particles_, passes_, count_, shares_, *executor_);
  viscosity_iterations_ = outcome.iterations;
  if (!outcome.converged) ++counter(Counter::viscosity_unsolved);
  // Viscosity takes from the whole, but along pairs only, so that a particle of a fast body may gain.
  KickResult<Real> total = kick_results_[0];
  executor_->run(shares_, [&](int share) {
    kick_results_[static_cast<std::size_t>(share)] = boundSpeeds(particles_, caps_.speed, ShareRange{count_, share, shares_});
  });
  for (int share = 0; share < shares_; ++share) total.merge(kick_results_[static_cast<std::size_t>(share)]);
  kick_results_[0] = total;
  return outcome.finite;
}

/// What the present motion allows, s; `implicit` says how viscosity is solved.
template <class Real>
double WorldCore<Real>::allowedTimeStep(bool implicit, double before) const {
  TimeStepLimits limits = limits_;
  if (implicit) limits.viscous = kAnyTime;
  const double acceleration = std::sqrt(static_cast<double>(kick_results_[0].max_acceleration2));
  return stableTimeStep(limits, max_speed_, acceleration, before);
}

template <class Real>
void WorldCore<Real>::chooseTimeStep(double before) {
  solving_viscosity_ = mustSolveViscosity(allowedTimeStep(true, kAnyTime));
  if (!solving_viscosity_) viscosity_iterations_ = 0;
  next_dt_ = allowedTimeStep(solving_viscosity_, before);
}

/// Whether viscosity is solved implicitly where the step's other limits allow `other_limit`, s.
template <class Real>
bool WorldCore<Real>::mustSolveViscosity(double other_limit) const {
  if (!implicit_viscosity_) return false;
  if (description_.effects.viscosity->solve == ViscositySolve::implicit) return true;
  return limits_.viscous < (solving_viscosity_ ? kImplicitBand : 1.0) * other_limit;
}

template class WorldCore<float>;
template class WorldCore<double>;

}  // namespace bleedsim::sph
