// World for one scalar type: owns the state and runs the stages of a step.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "service/sph/effects/applied_force.h"
#include "service/sph/effects/core_radius.h"
#include "service/sph/effects/implicit_viscosity.h"
#include "service/sph/effects/literal_core_radius.h"
#include "service/sph/effects/literal_forces.h"
#include "service/sph/effects/platelets.h"
#include "service/sph/effects/rheology.h"
#include "service/sph/effects/shear_rate.h"
#include "service/sph/effects/surface_tension.h"
#include "service/sph/executor.h"
#include "service/sph/integrate/closing_kick.h"
#include "service/sph/integrate/kick_drift.h"
#include "service/sph/integrate/time_step.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/neighbors/coincidence.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/recovery.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/seeding.h"
#include "service/sph/stage_clock.h"
#include "service/sph/step_scratch.h"
#include "service/sph/tissue/wall_effects.h"
#include "service/sph/world.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {

/// The compiled code that a world runs.
template <class Real>
struct WorldTables {
  const PassTable<Real>& passes;
  const SweepTable<Real>& sweeps;
};

template <class Real>
class WorldCore final : public World {
 public:
  /// `tissue` of the description, already built; `tables` of `target`.
  WorldCore(const WorldDescription& description, const WorldOptions& options, SimdTarget target, const WorldTables<Real>& tables,
            const RestLattice& lattice, TissueField<Real> tissue);

  /// Places the fluid blocks and opens the scene's wounds; then computes the first accelerations. Once, before the first step.
  Status populate();

  Result<Applied> apply(const Command& command) override;
  Status checkWound(const Command& command) const override;
  Status step(double dt_limit) override;
  std::uint64_t stepCount() const override { return steps_; }
  double time() const override { return time_; }
  std::uint32_t particleCount() const override { return count_ - unseen_; }
  void collectStats(WorldStats& stats) const override;
  std::span<const WoundState> wounds() const override { return wounds_.states(); }
  void copyFrame(FrameBuffer& frame, std::uint32_t attributes) const override;
  std::uint64_t stateHash() const override;
  Status adopt(World& world) override;
  std::size_t stateBytes() const override;
  std::size_t saveState(std::span<std::byte> room) const override;
  Status restoreState(std::span<const std::byte> state) override;
  std::string_view woundName(std::uint32_t id) const override;
  const WorldDescription& description() const override { return description_; }
  SimdTarget simdTarget() const override { return target_; }
  double speedOfSound() const override { return speed_of_sound_; }
  double particleMass() const override { return lattice_.particle_mass; }
  bool faulted() const override { return faulted_; }
  MemoryUse memory() const override;
  RunningCode runningCode() const override;

 private:
  // A step that held, and what is done about one that did not.
  Trouble attempt(double dt);
  double recover(double dt, Trouble trouble);
  void mark();
  void rewind();
  void showLastState();

  // The stages, in order.
  void emit(double dt);
  void move(double dt);
  void holdStill();
  void findNeighbors(const Bounds<Real>& bounds, Real half_kick);
  void computeAccelerations();
  template <class Job>
  bool passPairsAtOnce(void (*forces)(const Job&), const Job& job);
  void changeBlood();
  bool closeKick(double dt);
  void finishStep(double dt);
  bool solveViscosity(double dt);
  double allowedTimeStep(bool implicit, double before) const;
  void chooseTimeStep(double before);
  bool mustSolveViscosity(double other_limit) const;

  const Real* shearRates() const { return shear_rate_ ? shear_rate_->data() : nullptr; }
  void makeBlood(std::uint32_t i, std::optional<double> viscosity, std::optional<double> platelet);
  void chooseShares();
  // world_state.cpp
  struct SavedScalars;
  SavedScalars scalars() const;
  void save(StateWriter& out) const;
  Status checkScalars(const SavedScalars& saved) const;
  Status checkParticles(const SavedScalars& saved, const WoundSet& wounds) const;
  Status checkParticle(std::uint32_t i, const SavedScalars& saved, const WoundSet& wounds) const;
  Status readForces(StateReader& in, std::vector<SetForce>& sources) const;
  void withdraw(const Throat& throat);
  std::uint64_t& counter(Counter c) { return counters_[static_cast<std::size_t>(c)]; }

  WorldDescription description_;
  SimdTarget target_;
  double speed_of_sound_;
  RestLattice lattice_;
  double h_;
  DomainBox<Real> domain_;
  MotionCaps<Real> caps_;
  std::array<Real, 3> gravity_{};
  TimeStepLimits limits_;
  double opening_ = 0.5;  // part of the kick before the drift: a half, or symplectic Euler's whole

  std::unique_ptr<Executor> executor_;
  int shares_ = 1;
  Particles<Real> particles_, sorted_;
  CellGrid<Real> grid_;
  Coincidence<Real> coincidence_;
  PairPasses<Real> passes_;
  WallEffects<Real> walls_;
  WoundSet wounds_;
  std::optional<AppliedForce<Real>> applied_force_;
  std::optional<LiteralForces<Real>> literal_;
  std::optional<LiteralCoreRadius<Real>> literal_radius_;
  std::optional<CoreRadius<Real>> core_radius_;
  StepScratch scratch_;
  std::optional<ShearRate<Real>> shear_rate_;
  std::optional<EffectiveViscosity<Real>> rheology_;
  std::optional<Clotting<Real>> clotting_;
  bool thins_ = false;               // viscosity depends on the shear rate
  bool clotting_due_ = true;         // in this step
  std::uint64_t clotting_step_ = 0;  // the first one in which it is due
  double clotting_time_ = 0.0;       // that the platelets have not lived through yet, s
  std::optional<ImplicitViscosity<Real>> implicit_viscosity_;
  bool solving_viscosity_ = false;  // implicitly, in this step
  int viscosity_iterations_ = 0;
  std::optional<SurfaceTension<Real>> surface_tension_;
  std::vector<DriftResult<Real>> drift_results_;
  std::vector<KickResult<Real>> kick_results_;

  std::uint32_t count_ = 0;   // particles in the arrays, those behind patches included
  std::uint32_t unseen_ = 0;  // of them behind patches
  std::uint32_t next_id_ = 1;
  std::uint64_t injected_ = 0;
  std::uint64_t removed_ = 0;
  std::uint64_t steps_ = 0;
  double time_ = 0.0;
  double last_dt_ = 0.0;
  double next_dt_ = 0.0;
  double max_speed_ = 0.0;
  double repulsion_start_ = -std::numeric_limits<double>::infinity();  // simulated time at which it was switched on, s
  bool faulted_ = false;
  bool guarded_ = false;  // the attempt is the ladder's last
  struct Before {
    std::uint32_t count = 0, unseen = 0, next_id = 0;
    std::uint64_t injected = 0, removed = 0;
    std::array<std::uint64_t, static_cast<std::size_t>(Counter::count)> counters{};
  };
  Before before_;  // the step that is being made
  StageClock clock_;
  std::array<std::uint64_t, static_cast<std::size_t>(Counter::count)> counters_{};
};

}  // namespace bleedsim::sph
