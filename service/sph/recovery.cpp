// The rungs of recovery.h in a world: a step that did not hold is taken back and made again.
#include "service/sph/recovery.h"

#include "service/sph/world_core.h"

namespace bleedsim::sph {

/// Climbs until a step holds. Returns the time that it took, s; the world is faulted if none did.
template <class Real>
double WorldCore<Real>::recover(double dt, Trouble trouble) {
  for (int halvings = 0; trouble != Trouble::none && halvings < kMostHalvings; ++halvings) {
    rewind();
    ++counter(Counter::step_retried);
    dt *= 0.5;
    trouble = attempt(dt);
  }
  if (trouble != Trouble::not_finite) return dt;  // still long: the bounds on acceleration and speed hold it
  rewind();
  guarded_ = true;
  trouble = attempt(dt);
  guarded_ = false;
  const KickResult<Real>& kick = kick_results_[0];
  if (trouble == Trouble::not_finite || 2 * kick.frozen > kick.free) {
    rewind();
    showLastState();
    faulted_ = true;
    return dt;
  }
  counter(Counter::infinite_force_capped) += kick.capped;
  counter(Counter::particle_frozen) += kick.frozen;
  return dt;
}

template <class Real>
void WorldCore<Real>::mark() {
  before_ = {count_, unseen_, next_id_, injected_, removed_, counters_};
}

/// Takes the attempt back. The sort left its source alone, and the drift wrote beside it.
template <class Real>
void WorldCore<Real>::rewind() {
  particles_.swap(sorted_);
  passes_.exchangeAccelerations();
  wounds_.rewind();
  count_ = before_.count;
  unseen_ = before_.unseen;
  next_id_ = before_.next_id;
  injected_ = before_.injected;
  removed_ = before_.removed;
  for (const Counter c : kCountedInAttempts) counter(c) = before_.counters[static_cast<std::size_t>(c)];
}

/// Densities are those of the attempt, in its order: a faulted world still makes frames.
template <class Real>
void WorldCore<Real>::showLastState() {
  holdStill();
  walls_.sample(grid_, particles_, wounds_, count_, shares_, *executor_);
  passes_.density(grid_, particles_, walls_.share(), count_, shares_, *executor_);
}

template double WorldCore<float>::recover(double, Trouble);
template double WorldCore<double>::recover(double, Trouble);
template void WorldCore<float>::mark();
template void WorldCore<double>::mark();

}  // namespace bleedsim::sph
