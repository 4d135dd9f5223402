// What a world tells of itself: figures, frames, the hash of its state, memory and running code.
#include "service/sph/view.h"
#include "service/sph/world_core.h"

namespace bleedsim::sph {

template <class Real>
void WorldCore<Real>::collectStats(WorldStats& stats) const {
  stats.step = steps_;
  stats.time = time_;
  stats.dt = last_dt_;
  stats.particles = particleCount();
  stats.injected = injected_;
  stats.removed = removed_;
  stats.emitted_volume = wounds_.emittedVolume();
  stats.commanded_volume = wounds_.commandedVolume();
  stats.max_speed = max_speed_;
  stats.viscosity_iterations = viscosity_iterations_;
  addParticleStats(particles_, passes_.density(), count_, h_, description_.rest_density, lattice_.particle_mass, stats);
  stats.stage_seconds = clock_.seconds();
  stats.counters = counters_;
  stats.counters[static_cast<std::size_t>(Counter::emission_refused)] = wounds_.refusedParticles();
  stats.counters[static_cast<std::size_t>(Counter::inlet_withdrawn)] = wounds_.withdrawnParticles();
}

template <class Real>
void WorldCore<Real>::copyFrame(FrameBuffer& frame, std::uint32_t attributes) const {
  frame.step = steps_;
  frame.time = time_;
  copyVisible(particles_, passes_.density(), count_, h_, wounds_,
              description_.effects.viscosity ? description_.effects.viscosity->viscosity : 0.0, attributes, frame);
}

template <class Real>
std::uint64_t WorldCore<Real>::stateHash() const {
  return hashState(particles_, count_, time_);
}

template <class Real>
MemoryUse WorldCore<Real>::memory() const {
  MemoryUse use;
  use.particles = particles_.bytes() + sorted_.bytes();
  use.passes = passes_.bytes();
  use.lists = passes_.listBytes();
  use.grid = grid_.bytes() + coincidence_.bytes();
  use.tissue = walls_.bytes();
  use.effects = scratch_.bytes();
  if (shear_rate_) use.effects += shear_rate_->bytes();
  if (implicit_viscosity_) use.effects += implicit_viscosity_->bytes();
  if (surface_tension_) use.effects += surface_tension_->bytes();
  if (applied_force_) use.effects += applied_force_->bytes();
  return use;
}

template <class Real>
RunningCode WorldCore<Real>::runningCode() const {
  RunningCode code;
  code.density = passes_.densityCode();
  code.pair_forces = literal_ ? literal_->forceCode() : passes_.forceCode(!solving_viscosity_);
  if (shear_rate_) code.shear_rate = shear_rate_->code();
  if (clotting_) code.platelets = clotting_->code();
  if (surface_tension_) code.curvature = surface_tension_->code();
  if (solving_viscosity_) code.viscous_product = implicit_viscosity_->code();
  return code;
}

template void WorldCore<float>::collectStats(WorldStats&) const;
template void WorldCore<float>::copyFrame(FrameBuffer&, std::uint32_t) const;
template std::uint64_t WorldCore<float>::stateHash() const;
template MemoryUse WorldCore<float>::memory() const;
template RunningCode WorldCore<float>::runningCode() const;
template void WorldCore<double>::collectStats(WorldStats&) const;
template void WorldCore<double>::copyFrame(FrameBuffer&, std::uint32_t) const;
template std::uint64_t WorldCore<double>::stateHash() const;
template MemoryUse WorldCore<double>::memory() const;
template RunningCode WorldCore<double>::runningCode() const;

}  // namespace bleedsim::sph
