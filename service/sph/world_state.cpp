// The complete state of a world as bytes. What a step works out anew (grid, lists, tissue samples, densities' records) is left
// out.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "service/sph/description_hash.h"
#include "service/sph/state_bytes.h"
#include "service/sph/world_core.h"
#include "service/sph/world_setup.h"
#include "service/sph/wound/text.h"

namespace bleedsim::sph {
namespace {

constexpr std::uint64_t kStateMark = 0x33305753'44454c42u;  // "BLEDSW03"

// Velocities are capped at 2 c0 and then only slowed down; this leaves room for rounding.
constexpr double kMostSpeed = 4.0;

Status damaged(std::string what) { return {StatusCode::data_loss, std::move(what)}; }
Status foreign(std::string what) { return {StatusCode::invalid_argument, std::move(what)}; }

bool isTime(double value) { return value >= 0.0 && std::isfinite(value); }

void saveForce(const SetForce& source, StateWriter& out) {
  out.value(source.key);
  for (Eigen::Index a = 0; a < 3; ++a) out.value(source.position[a]);
  out.value(source.radius);
  for (Eigen::Index a = 0; a < 3; ++a) out.value(source.force[a]);
  out.value(source.until);
}
constexpr std::size_t kForceBytes = 9 * 8;

SetForce readForce(StateReader& in) {
  SetForce source;
  source.key = in.value<ForceKey>();
  for (Eigen::Index a = 0; a < 3; ++a) source.position[a] = in.value<double>();
  source.radius = in.value<double>();
  for (Eigen::Index a = 0; a < 3; ++a) source.force[a] = in.value<double>();
  source.until = in.value<double>();
  return source;
}

/// visit(array, values for each particle) of all arrays that belong to a state, in the file's order.
template <class P, class Visit>
void forEachField(P& particles, Visit&& visit) {
  visit(particles.x);
  visit(particles.y);
  visit(particles.z);
  visit(particles.vx);
  visit(particles.vy);
  visit(particles.vz);
  visit(particles.inverse_viscosity);
  visit(particles.own_viscosity);
  visit(particles.platelet);
  visit(particles.radius);
  visit(particles.id);
  visit(particles.driver);
}

template <class Real>
bool finiteOrEmpty(const AlignedArray<Real>& values, std::uint32_t i) {
  return values.empty() || std::isfinite(values[i]);
}

}  // namespace

/// Everything that is one number. Eight bytes each, so that no byte is left undefined.
template <class Real>
struct WorldCore<Real>::SavedScalars {
  std::uint64_t mark = kStateMark;
  std::uint64_t real_bytes = sizeof(Real);
  std::uint64_t description = 0;
  double speed_of_sound = 0.0;
  std::uint64_t count = 0;
  std::uint64_t unseen = 0;
  std::uint64_t next_id = 1;
  std::uint64_t injected = 0;
  std::uint64_t removed = 0;
  std::uint64_t steps = 0;
  double time = 0.0;
  double last_dt = 0.0;
  double next_dt = 0.0;
  double max_speed = 0.0;
  double max_acceleration2 = 0.0;
  double max_speed2 = 0.0;
  double repulsion_start = 0.0;
  double viscous_limit = 0.0;
  double reach = 1.0;
  std::uint64_t solving_viscosity = 0;
  std::uint64_t viscosity_iterations = 0;
  std::uint64_t clotting_step = 0;
  double clotting_time = 0.0;
  std::array<std::uint64_t, static_cast<std::size_t>(Counter::count)> counters{};
};

template <class Real>
typename WorldCore<Real>::SavedScalars WorldCore<Real>::scalars() const {
  SavedScalars saved;
  saved.description = descriptionHash(description_);
  saved.speed_of_sound = speed_of_sound_;
  saved.count = count_;
  saved.unseen = unseen_;
  saved.next_id = next_id_;
  saved.injected = injected_;
  saved.removed = removed_;
  saved.steps = steps_;
  saved.time = time_;
  saved.last_dt = last_dt_;
  saved.next_dt = next_dt_;
  saved.max_speed = max_speed_;
  saved.max_acceleration2 = static_cast<double>(kick_results_[0].max_acceleration2);
  saved.max_speed2 = static_cast<double>(kick_results_[0].max_speed2);
  saved.repulsion_start = repulsion_start_;
  saved.viscous_limit = limits_.viscous;
  saved.reach = static_cast<double>(passes_.reach());
  saved.solving_viscosity = solving_viscosity_ ? 1 : 0;
  saved.viscosity_iterations = static_cast<std::uint64_t>(viscosity_iterations_);
  saved.clotting_step = clotting_step_;
  saved.clotting_time = clotting_time_;
  saved.counters = counters_;
  return saved;
}

template <class Real>
void WorldCore<Real>::save(StateWriter& out) const {
  out.value(scalars());
  forEachField(particles_, [&](const auto& array) {
    if (!array.empty()) out.array(array.data(), count_);
  });
  out.array(passes_.density(), count_);
  out.array(passes_.acceleration(), std::size_t{count_} * 4);
  wounds_.save(out);
  const std::span<const SetForce> sources = applied_force_ ? applied_force_->sources() : std::span<const SetForce>{};
  out.value(static_cast<std::uint32_t>(sources.size()));
  for (const SetForce& source : sources) saveForce(source, out);
}

template <class Real>
std::size_t WorldCore<Real>::stateBytes() const {
  StateWriter counting;
  save(counting);
  return counting.used();
}

template <class Real>
std::size_t WorldCore<Real>::saveState(std::span<std::byte> room) const {
  if (faulted_) return 0;
  StateWriter out{room};
  save(out);
  return out.used() <= room.size() ? out.used() : 0;
}

template <class Real>
Status WorldCore<Real>::checkScalars(const SavedScalars& saved) const {
  if (saved.mark != kStateMark) return damaged("it is no state of a world, or of another version");
  if (saved.real_bytes != sizeof(Real)) return foreign("the state is of another precision: use the same");
  if (saved.description != descriptionHash(description_)) return foreign("the state is that of another scene");
  if (saved.speed_of_sound != speed_of_sound_) return foreign("the state is that of another speed of sound");
  if (saved.count > description_.capacity) {
    return damaged(textOf("the state has ", saved.count, " particles, more than the capacity of ", description_.capacity));
  }
  if (saved.unseen > saved.count || saved.next_id == 0 || saved.next_id > std::numeric_limits<std::uint32_t>::max()) {
    return damaged("the numbers of particles do not agree");
  }
  if (!isTime(saved.time) || !isTime(saved.clotting_time) || !isTime(saved.last_dt) || !isTime(saved.next_dt) ||
      !(saved.next_dt > 0.0)) {
    return damaged("the state's time is not a time");
  }
  if (!isTime(saved.max_speed) || !isTime(saved.max_acceleration2) || !isTime(saved.max_speed2) ||
      std::isnan(saved.repulsion_start) || !(saved.viscous_limit > 0.0)) {
    return damaged("a limit of the time step is not a number");
  }
  if (saved.clotting_step > saved.steps + kClottingSteps) return damaged("the clotting is due too late");
  const double largest = std::max(1.0, radiusBounds(description_).largest);
  if (!(saved.reach >= 1.0) || static_cast<Real>(saved.reach) > static_cast<Real>(largest)) {
    return damaged("the reach of the neighbour search is out of its bounds");
  }
  if (saved.solving_viscosity > (implicit_viscosity_ ? 1u : 0u)) return damaged("the scene has no implicit viscosity");
  return {};
}

/// Of the arrays that the sort writes next: they hold nothing between two steps, so that the state is read into them.
template <class Real>
Status WorldCore<Real>::checkParticles(const SavedScalars& saved, const WoundSet& wounds) const {
  const auto count = static_cast<std::uint32_t>(saved.count);
  std::vector<std::uint32_t> ids(sorted_.id.data(), sorted_.id.data() + count);
  std::sort(ids.begin(), ids.end());
  if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) return damaged("two particles have one id");
  if (count > 0 && (ids.front() == 0 || ids.back() >= saved.next_id)) return damaged("a particle's id was never given");
  std::uint64_t unseen = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (Status status = checkParticle(i, saved, wounds); !status.ok()) return status;
    const std::uint32_t driver = sorted_.driver[i];
    if (driver != 0 && wounds.kinematics(driver).phase == InletPhase::throat) ++unseen;
  }
  if (unseen != saved.unseen) return damaged("the particles behind the wounds' patches are not those of the ledger");
  return {};
}

template <class Real>
Status WorldCore<Real>::checkParticle(std::uint32_t i, const SavedScalars& saved, const WoundSet& wounds) const {
  const auto wrong = [&](const char* what) { return damaged(textOf("particle ", sorted_.id[i], ": its ", what)); };
  const std::array<const AlignedArray<Real>*, 3> position{&sorted_.x, &sorted_.y, &sorted_.z};
  const std::array<const AlignedArray<Real>*, 3> velocity{&sorted_.vx, &sorted_.vy, &sorted_.vz};
  const auto margin = static_cast<Real>(kThroatMargin / description_.support_ratio);
  const auto most_speed = static_cast<Real>(kMostSpeed * speed_of_sound_);
  const bool driven = sorted_.driver[i] != 0;
  if (driven && !wounds.mayDrive(sorted_.driver[i])) return wrong("wound does not exist");
  for (std::size_t a = 0; a < 3; ++a) {
    const Real x = (*position[a])[i];
    if (!std::isfinite(x)) return wrong("position is not finite");
    if (!driven && (x < domain_.lower[a] - margin || x > domain_.upper[a] + margin)) {
      return wrong("position is outside the domain");
    }
    if (!(std::abs((*velocity[a])[i]) <= most_speed)) return wrong("velocity is not finite or faster than the solver allows");
  }
  if (!sorted_.inverse_viscosity.empty() && !(sorted_.inverse_viscosity[i] > Real(0))) return wrong("viscosity is no viscosity");
  if (!finiteOrEmpty(sorted_.own_viscosity, i) || !finiteOrEmpty(sorted_.platelet, i)) return wrong("blood is not finite");
  if (!sorted_.radius.empty()) {
    const RadiusBounds bounds = radiusBounds(description_);
    const Real radius = sorted_.radius[i];
    const auto least = static_cast<Real>(std::min(1.0, bounds.smallest));
    if (!(radius >= least) || radius > static_cast<Real>(saved.reach)) return wrong("support radius is out of its bounds");
  }
  return {};
}

template <class Real>
Status WorldCore<Real>::readForces(StateReader& in, std::vector<SetForce>& sources) const {
  const std::uint32_t most = applied_force_ ? applied_force_->maxSources() : 0;
  const std::uint32_t count = in.count(most, kForceBytes);
  for (std::uint32_t k = 0; k < count; ++k) {
    const SetForce source = readForce(in);
    if (Status status = checkForce(source, description_.domain); !status.ok()) return damaged(status.message());
    const auto same = [&source](const SetForce& other) { return other.key == source.key; };
    if (std::any_of(sources.begin(), sources.end(), same)) return damaged("two force sources have one key");
    sources.push_back(source);
  }
  if (in.failed()) return damaged("the state has more force sources than the scene, or ends within them");
  return {};
}

template <class Real>
Status WorldCore<Real>::restoreState(std::span<const std::byte> state) {
  StateReader in{state};
  const auto saved = in.value<SavedScalars>();
  if (in.failed()) return damaged("the state ends before its particles");
  if (Status status = checkScalars(saved); !status.ok()) return status;
  const auto count = static_cast<std::uint32_t>(saved.count);
  forEachField(sorted_, [&](auto& array) {
    if (!array.empty()) in.array(array.data(), count);
  });
  std::vector<Real> density(count);
  std::vector<Real> acceleration(std::size_t{count} * 4);
  in.array(density.data(), density.size());
  in.array(acceleration.data(), acceleration.size());
  if (in.failed()) return damaged("the state ends within its particles");
  const auto finite = [](Real value) { return std::isfinite(value); };
  if (!std::all_of(density.begin(), density.end(), [](Real rho) { return rho > Real(0) && std::isfinite(rho); }) ||
      !std::all_of(acceleration.begin(), acceleration.end(), finite)) {
    return damaged("a density or an acceleration is not finite");
  }
  WoundSet wounds{description_, speed_of_sound_};
  if (Status status = wounds.restore(in); !status.ok()) return status;
  if (Status status = checkParticles(saved, wounds); !status.ok()) return status;
  std::vector<SetForce> sources;
  if (Status status = readForces(in, sources); !status.ok()) return status;
  if (!in.atEnd()) return damaged("the state goes on after its end");

  particles_.swap(sorted_);
  std::copy(density.begin(), density.end(), passes_.density());
  std::copy(acceleration.begin(), acceleration.end(), passes_.acceleration());
  std::swap(wounds_, wounds);
  if (applied_force_) {
    applied_force_->clear();
    for (const SetForce& source : sources) static_cast<void>(applied_force_->set(source));
  }
  count_ = count;
  unseen_ = static_cast<std::uint32_t>(saved.unseen);
  next_id_ = static_cast<std::uint32_t>(saved.next_id);
  injected_ = saved.injected;
  removed_ = saved.removed;
  steps_ = saved.steps;
  time_ = saved.time;
  last_dt_ = saved.last_dt;
  next_dt_ = saved.next_dt;
  max_speed_ = saved.max_speed;
  kick_results_[0].max_acceleration2 = static_cast<Real>(saved.max_acceleration2);
  kick_results_[0].max_speed2 = static_cast<Real>(saved.max_speed2);
  repulsion_start_ = saved.repulsion_start;
  limits_.viscous = saved.viscous_limit;
  passes_.setReach(static_cast<Real>(saved.reach));
  solving_viscosity_ = saved.solving_viscosity != 0;
  viscosity_iterations_ = static_cast<int>(std::min<std::uint64_t>(saved.viscosity_iterations, std::numeric_limits<int>::max()));
  clotting_step_ = saved.clotting_step;
  clotting_time_ = saved.clotting_time;
  counters_ = saved.counters;
  faulted_ = false;
  return {};
}

template <class Real>
std::string_view WorldCore<Real>::woundName(std::uint32_t id) const {
  const WoundDescription* wound = wounds_.description(id);
  return wound == nullptr ? std::string_view{} : std::string_view{wound->name};
}

template std::size_t WorldCore<float>::stateBytes() const;
template std::size_t WorldCore<double>::stateBytes() const;
template std::size_t WorldCore<float>::saveState(std::span<std::byte> room) const;
template std::size_t WorldCore<double>::saveState(std::span<std::byte> room) const;
template Status WorldCore<float>::restoreState(std::span<const std::byte> state);
template Status WorldCore<double>::restoreState(std::span<const std::byte> state);
template std::string_view WorldCore<float>::woundName(std::uint32_t id) const;
template std::string_view WorldCore<double>::woundName(std::uint32_t id) const;

}  // namespace bleedsim::sph
