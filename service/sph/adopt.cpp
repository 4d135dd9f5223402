// One world takes over the state of another: arrays and tables are swapped, so that nothing is allocated or freed here.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "service/sph/world_core.h"
#include "service/sph/world_setup.h"

namespace bleedsim::sph {
namespace {

/// What must agree for arrays, tables and calibration to mean the same in both worlds.
bool sameBody(const WorldDescription& a, const WorldDescription& b) {
  return a.domain.lower == b.domain.lower && a.domain.upper == b.domain.upper && a.domain.periodic == b.domain.periodic &&
         a.capacity == b.capacity && a.spacing == b.spacing && a.support_ratio == b.support_ratio && a.kernel == b.kernel &&
         a.rest_density == b.rest_density && a.model == b.model && a.planar == b.planar && a.tissue.size() == b.tissue.size() &&
         a.max_wounds == b.max_wounds;
}

template <class Real>
void takeOrFill(AlignedArray<Real>& mine, AlignedArray<Real>& other, std::uint32_t count, Real fresh) {
  if (mine.empty()) return;
  if (other.empty()) {
    std::fill_n(mine.data(), count, fresh);
  } else {
    mine.swap(other);
  }
}

}  // namespace

template <class Real>
Status WorldCore<Real>::adopt(World& world) {
  auto* from = dynamic_cast<WorldCore<Real>*>(&world);
  if (from == nullptr) return {StatusCode::invalid_argument, "the other world has another precision: use the same"};
  if (from == this) return {};
  if (!sameBody(description_, from->description_) || speed_of_sound_ != from->speed_of_sound_) {
    return {StatusCode::invalid_argument, "the worlds differ in more than their effects: use one description"};
  }
  if (from->faulted_) return {StatusCode::wrong_state, "the other world is faulted: its state is not finite"};
  if (applied_force_ && from->applied_force_ && !applied_force_->canHold(*from->applied_force_)) {
    return {StatusCode::capacity, "more force sources push than applied_force.max_sources: wait, or raise it"};
  }

  // Blood of the former default viscosity follows the new default; a fluid block's own stays.
  const double before = from->description_.effects.viscosity ? from->description_.effects.viscosity->viscosity : 0.0;
  const double after = description_.effects.viscosity ? description_.effects.viscosity->viscosity : 0.0;
  const auto former_default = static_cast<Real>(1.0 / before);
  const auto present_default = static_cast<Real>(1.0 / after);
  Particles<Real>& theirs = from->particles_;
  count_ = from->count_;
  for (auto array : {&Particles<Real>::x, &Particles<Real>::y, &Particles<Real>::z, &Particles<Real>::vx, &Particles<Real>::vy,
                     &Particles<Real>::vz}) {
    (particles_.*array).swap(theirs.*array);
  }
  particles_.id.swap(theirs.id);
  particles_.driver.swap(theirs.driver);
  takeOrFill(particles_.inverse_viscosity, theirs.inverse_viscosity, count_, present_default);
  if (!particles_.inverse_viscosity.empty() && former_default != present_default) {
    std::replace(particles_.inverse_viscosity.data(), particles_.inverse_viscosity.data() + count_, former_default,
                 present_default);
  }
  takeOrFill(particles_.own_viscosity, theirs.own_viscosity, count_, Real(0));
  takeOrFill(particles_.platelet, theirs.platelet, count_,
             static_cast<Real>(description_.effects.platelets.value_or(PlateletSettings{}).fresh));
  takeOrFill(particles_.radius, theirs.radius, count_, Real(1));
  if (description_.effects.core_radius) {
    const RadiusBounds bounds = radiusBounds(description_);
    const auto smallest = static_cast<Real>(bounds.smallest);
    const auto largest = static_cast<Real>(bounds.largest);
    for (std::uint32_t i = 0; i < count_; ++i) particles_.radius[i] = std::clamp(particles_.radius[i], smallest, largest);
    passes_.setReach(std::min(from->passes_.reach(), std::max(Real(1), largest)));
  }
  passes_.adopt(from->passes_);
  std::swap(wounds_, from->wounds_);
  if (applied_force_ && from->applied_force_) applied_force_->adopt(*from->applied_force_);

  unseen_ = from->unseen_;
  next_id_ = from->next_id_;
  injected_ = from->injected_;
  removed_ = from->removed_;
  steps_ = from->steps_;
  time_ = from->time_;
  last_dt_ = from->last_dt_;
  max_speed_ = from->max_speed_;
  clock_ = from->clock_;
  counters_ = from->counters_;
  kick_results_[0] = from->kick_results_[0];
  repulsion_start_ = from->description_.effects.repulsion ? from->repulsion_start_ : from->time_;
  solving_viscosity_ = from->solving_viscosity_;
  viscosity_iterations_ = from->viscosity_iterations_;
  clotting_time_ = from->clotting_time_;
  clotting_step_ = steps_;  // at once: viscosities and the limit that comes of them are made anew
  // The step that was due, unless an effect that is new here allows less.
  chooseTimeStep(std::numeric_limits<double>::infinity());
  next_dt_ = std::min(from->next_dt_, next_dt_);
  return {};
}

template Status WorldCore<float>::adopt(World& world);
template Status WorldCore<double>::adopt(World& world);

}  // namespace bleedsim::sph
