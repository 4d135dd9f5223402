#include "service/daemon/simulation.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

#include "service/dds/frame_encoder.h"
#include "service/transport/clock.h"

namespace bleedsim::daemon {
namespace {

// Waiting for less than this costs more than it gives: a state may be up to this early.
constexpr double kWaitGrainSeconds = 0.5e-3;
// Inputs that found no room for their reply are looked at again after this time.
constexpr std::chrono::milliseconds kRetry{5};

Clock::duration wallSeconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{value});
}

dds::SceneReport describe(const scene::SceneDescription& scene, const sph::World& world, std::uint32_t epoch, double frame_rate) {
  dds::SceneReport report;
  report.known_effects = scene::knownEffects();
  report.epoch = epoch;
  report.simd_target = sph::simdTargetName(world.simdTarget());
  report.precision = "float32";
  report.name = scene.name;
  report.text = scene.normalized_text;
  report.seed = scene.world.seed;
  report.effects = scene.effects;
  report.frame_id = scene.frame_id;
  report.domain = scene.world.domain;
  report.spacing = scene.world.spacing;
  report.support_radius = scene.world.supportRadius();
  report.particle_volume = scene.world.particleVolume();
  report.rest_density = scene.world.rest_density;
  report.speed_of_sound = world.speedOfSound();
  report.frame_rate = frame_rate;
  report.capacity = scene.world.capacity;
  return report;
}

}  // namespace

Simulation::Simulation(const SimulationOptions& options, LoadedScene first, SceneFactory factory, Channels& channels,
                       TimePoint now)
    : options_{options},
      channels_{channels},
      loader_{std::move(factory), channels.commands.wakeup()},
      pacer_{options.pace, now},
      frame_clock_{options.frame_rate.value_or(first.scene->frame_rate)} {
  attributes_ = first.scene->attributes;
  if (options.keeper != nullptr && options.checkpoint_every) checkpoint_clock_.emplace(1.0 / *options.checkpoint_every);
  const bool paused = first.restored && first.restored->head.mark.paused;
  install(std::move(first), now);
  if (!paused) return;
  pacer_.pause(now, world_->time());
  showState();
}

void Simulation::install(LoadedScene loaded, TimePoint now) {
  const bool other_scene = loaded.scene != loaded_scene_;
  world_ = std::move(loaded.world);
  scene_ = std::move(loaded.scene);
  loaded_scene_ = loaded.restored ? loaded.restored->loaded : scene_;
  ++epoch_;
  if (other_scene) {
    frame_clock_ = FrameClock{options_.frame_rate.value_or(scene_->frame_rate)};
    attributes_ = scene_->attributes;
  }
  faulted_ = false;
  fault_text_.clear();
  steps_left_ = 0;
  steps_in_frame_ = 0;
  stage_seconds_at_frame_ = {};
  narrowest_wound_ = std::numeric_limits<double>::infinity();
  instruments_.clear();
  wound_names_.clear();
  pacer_.restart(now, world_->time());
  channels_.journal.beginEpoch(epoch_);
  channels_.frames.renew(std::move(loaded.frames));
  if (loaded.restored) {
    goOnFrom(loaded.restored->head, now);
  } else {
    for (std::uint32_t i = 0; i < scene_->world.wounds.size(); ++i) wound_names_.set(i + 1, scene_->world.wounds[i].name);
    frame_clock_.restart();
    frame_clock_.take(world_->time());
  }
  attributes_ &= availableAttributes();
  if (durationOver()) ended_ = true;  // the state that a session resumes from may be its last
  // A killed daemon comes back to this epoch, not to the one before.
  checkpoint_due_ = checkpoint_clock_.has_value();
  if (checkpoint_clock_) checkpoint_clock_->setRate(checkpoint_clock_->rate(), world_->time());
  recordNewNotes({});
  postScene();
  publishFrame(now);
  showState();
}

bool Simulation::durationOver() const { return options_.duration && world_->time() >= *options_.duration; }

dds::SessionState Simulation::state() const {
  if (pending_load_) return dds::SessionState::loading;
  if (faulted_) return dds::SessionState::faulted;
  return pacer_.paused() ? dds::SessionState::paused : dds::SessionState::running;
}

void Simulation::postScene() {
  dds::SceneReport report = describe(*scene_, *world_, epoch_, frame_clock_.rate());
  report.loaded_text = loaded_scene_->normalized_text;
  channels_.board.postScene(std::make_shared<const dds::SceneReport>(std::move(report)));
}

void Simulation::showState() {
  channels_.board.change([this](dds::StatusReport& report) {
    report.state = state();
    report.epoch = epoch_;
    report.step = world_->stepCount();
    report.sim_time = world_->time();
    report.pace = pacer_.pace();
    report.frame_rate = frame_clock_.rate();
    report.particles = world_->particleCount();
    report.wounds = static_cast<std::uint32_t>(world_->wounds().size());
    report.text = fault_text_.empty() ? fmt::format("{}", fmt::join(notes(), "; ")) : fault_text_;
    report.lease_client = lease_.holder();
    report.lease_until_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(lease_.until().time_since_epoch()).count();
    report.full_frame_bytes = scene_->world.capacity * dds::frameBytesPerParticle(attributes_);
  });
  channels_.publisher.notify();
}

/// Whatever still waits for its reply gets one.
Simulation::Next Simulation::end() {
  const Status ending{StatusCode::wrong_state, "the session ends: nothing more is carried out"};
  if (pending_load_) answerLoad(*pending_load_, ending);
  if (pending_switch_ && pending_switch_->request) answer(*pending_switch_->request, ending, 0);
  for (const WaitingWound& waiting : std::exchange(waiting_wounds_, {})) answer(waiting.request, ending, 0);
  pending_load_.reset();
  pending_switch_.reset();
  if (asked_checkpoint_) answer(*asked_checkpoint_, ending, 0);
  asked_checkpoint_.reset();
  while (channels_.commands.tryPop(input_)) {
    if (const auto* request = std::get_if<dds::DecodedRequest>(&input_)) answer(*request, ending, 0);
  }
  return {Next::Kind::stop, {}};
}

Simulation::Next Simulation::tick(TimePoint now) {
  channels_.simulation_pulse.beat();
  finishLoading(now);
  finishSwitching();
  finishCheckpoint();
  const bool more = drainInputs(now);
  applyInstruments();
  endSilentInstruments(now);
  if (ended_ || stop_requested_.load(std::memory_order_relaxed)) return end();

  takeCheckpoint();
  const dds::SessionState current = state();
  // Steps by hand keep their place behind a switch or a wound that was asked for before them.
  const bool stepping = current == dds::SessionState::paused && steps_left_ > 0 && !pending_switch_;
  if (current == dds::SessionState::running || stepping) {
    const double ahead = stepping ? 0.0 : pacer_.secondsAhead(now, world_->time());
    if (ahead <= kWaitGrainSeconds) {
      advance(now);
      return ended_ ? end() : Next{Next::Kind::again, {}};
    }
    if (more) return {Next::Kind::again, {}};
    const TimePoint due = now + wallSeconds(ahead);
    return {Next::Kind::wait, std::min(due, nextExpiry().value_or(due))};
  }
  if (more) return {Next::Kind::again, {}};
  std::optional<TimePoint> until = nextExpiry();
  if (!channels_.commands.empty()) until = std::min(until.value_or(now + kRetry), now + kRetry);
  return {Next::Kind::wait, until};
}

void Simulation::run() {
  for (;;) {
    const Next next = tick(Clock::now());
    if (next.kind == Next::Kind::stop) return;
    if (next.kind == Next::Kind::wait) channels_.commands.wakeup().wait(next.until);
  }
}

void Simulation::requestStop() {
  stop_requested_.store(true, std::memory_order_relaxed);
  channels_.commands.wakeup().notify();
}

void Simulation::advance(TimePoint now) {
  if (const Status stepped = world_->step(std::numeric_limits<double>::infinity()); !stepped) {
    fault(stepped.message(), now);
    return;
  }
  ++steps_in_frame_;
  const bool in_pause = pacer_.paused();
  const double time = world_->time();
  channels_.board.progress(world_->stepCount(), time, world_->particleCount(), pacer_.realTimeFactor(now, time),
                           pacer_.behind(now, time));
  if (in_pause) --steps_left_;
  const bool frame_due = frame_clock_.take(time);
  if (checkpoint_clock_ && checkpoint_clock_->take(time)) checkpoint_due_ = true;
  ended_ = durationOver();
  // Whoever steps by hand, or ends the session at a time, wants to see the state it ends in.
  const bool last_by_hand = in_pause && steps_left_ == 0;
  if (frame_due || last_by_hand || ended_) publishFrame(now);
  if (last_by_hand) showState();
}

void Simulation::publishFrame(TimePoint now) {
  dds::FrameSnapshot& snapshot = *channels_.frames.back();
  world_->copyFrame(snapshot.frame, attributes_);
  world_->collectStats(snapshot.stats);
  channels_.board.countFaults(snapshot.stats.counters);
  const std::span<const sph::WoundState> wounds = world_->wounds();
  snapshot.wounds.assign(wounds.begin(),
                         wounds.begin() + static_cast<std::ptrdiff_t>(std::min(wounds.size(), dds::kMaxWoundLedgers)));
  snapshot.state_hash = world_->stateHash();
  snapshot.epoch = epoch_;
  snapshot.journal_number = channels_.journal.lastNumber();
  snapshot.steps_in_frame = steps_in_frame_;
  for (std::size_t i = 0; i < stage_seconds_at_frame_.size(); ++i) {
    const double spent = snapshot.stats.stage_seconds[i] - stage_seconds_at_frame_[i];
    snapshot.stage_microseconds[i] = steps_in_frame_ > 0 ? spent * 1e6 / steps_in_frame_ : 0.0;
  }
  stage_seconds_at_frame_ = snapshot.stats.stage_seconds;
  snapshot.instrument_count = instruments_.report(snapshot.instruments, world_->stepCount());
  snapshot.real_time_factor = pacer_.realTimeFactor(now, world_->time());
  snapshot.behind = pacer_.behind(now, world_->time());
  snapshot.monotonic_stamp_ns = transport::monotonicNow();
  snapshot.realtime_stamp_ns = transport::realtimeNow();
  steps_in_frame_ = 0;
  channels_.frames.store();
  channels_.publisher.notify();
}

void Simulation::fault(const std::string& reason, TimePoint now) {
  faulted_ = true;
  steps_left_ = 0;
  pacer_.pause(now, world_->time());
  fault_text_ = fmt::format("the solver stopped: {}; reset the session or load another scene", reason);
  record(dds::Decision{fault_text_});
  publishFrame(now);
  showState();
}

void Simulation::finishLoading(TimePoint now) {
  if (!pending_load_) return;
  std::optional<Result<LoadedScene>> finished = loader_.takeFinished();
  if (!finished) return;
  PendingLoad load = std::move(*pending_load_);
  pending_load_.reset();
  const Status outcome = finished->status();
  const bool goes_on = !load.stay_paused && (outcome || !load.was_faulted);
  if (goes_on) pacer_.resume(now, world_->time());
  if (outcome) {
    if ((*finished)->restored) load.checkpoint = (*finished)->restored->head.name;
    install(std::move(**finished), now);
  } else {
    showState();
  }
  answerLoad(load, outcome);
}

std::optional<TimePoint> Simulation::nextExpiry() const { return instruments_.nextExpiry(instrumentExpiry()); }

Clock::duration Simulation::instrumentExpiry() const { return wallSeconds(scene_->instrument_expiry); }

}  // namespace bleedsim::daemon
