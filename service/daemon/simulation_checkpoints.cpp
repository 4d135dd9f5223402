// Checkpoints: when they are taken, and how a session goes on from one.
#include <algorithm>

#include "service/daemon/checkpoint_keeper.h"
#include "service/daemon/simulation.h"

namespace bleedsim::daemon {
namespace {

Status noCheckpoints() {
  return {StatusCode::wrong_state, "bleedd keeps no checkpoints: start it with --checkpoint-every or --checkpoint-dir"};
}

}  // namespace

Status Simulation::wantCheckpoint() const {
  if (options_.keeper == nullptr) return noCheckpoints();
  if (pending_load_) return {StatusCode::wrong_state, "a scene is being loaded: wait for its reply"};
  if (faulted_) return {StatusCode::wrong_state, "the solver has stopped on bad numbers: its state is worth nothing"};
  if (asked_checkpoint_) return {StatusCode::wrong_state, "another checkpoint was asked for: wait for its reply"};
  return {};
}

Status Simulation::startRestoring(const std::string& name, TimePoint now) {
  if (options_.keeper == nullptr) return noCheckpoints();
  SceneJob job;
  job.checkpoint = name;
  return startLoading(std::move(job), false, now);
}

/// Between two steps, after all inputs of the coming one: a copy of the state goes to the keeper, if it has room now.
void Simulation::takeCheckpoint() {
  if (pending_load_ || faulted_ || saving_) return;
  const bool asked = asked_checkpoint_.has_value();
  if (!asked && !checkpoint_due_) return;
  const std::span<std::byte> room = options_.keeper->room(world_->stateBytes());
  if (room.empty()) return;
  CheckpointJob job;
  job.bytes = world_->saveState(room);
  if (job.bytes == 0) return;
  // One that is due as well is told by the same file, unless it has a name: those are not for the service to delete.
  if (asked) {
    job.name = std::get<dds::SaveCheckpoint>(asked_checkpoint_->action).name;
    if (job.name.empty()) checkpoint_due_ = false;
  } else {
    checkpoint_due_ = false;
  }
  job.simd_target = sph::simdTargetName(world_->simdTarget());
  job.scene = scene_;
  job.loaded = loaded_scene_;
  job.mark = sessionMark();
  saved_step_ = job.mark.step;
  saved_time_ = job.mark.sim_time;
  saving_ = true;
  saving_for_request_ = asked;
  options_.keeper->submit(std::move(job));
}

void Simulation::finishCheckpoint() {
  if (options_.keeper == nullptr) return;
  std::optional<CheckpointOutcome> outcome = options_.keeper->takeOutcome();
  if (!outcome) return;
  // Without memory for a copy nothing was handed over: whoever asked is told, and what is due is left out.
  const bool for_request = saving_ ? saving_for_request_ : asked_checkpoint_.has_value();
  if (!saving_) checkpoint_due_ = false;
  saving_ = false;
  channels_.counters.add(outcome->status ? ServiceCounter::checkpoints_written : ServiceCounter::checkpoints_failed);
  if (!for_request || !asked_checkpoint_) return;
  dds::DecodedRequest request = std::move(*asked_checkpoint_);
  asked_checkpoint_.reset();
  dds::Reply reply = replyTo(request, outcome->status, 0);
  if (outcome->status) {
    reply.object_name = outcome->name;
    reply.applied_step = saved_step_ + 1;
    reply.sim_time = saved_time_;
  }
  send(std::move(reply));
  if (outcome->status && request.original) record(dds::RequestTaken{std::move(request.original), 0});
}

checkpoint::SessionMark Simulation::sessionMark() const {
  checkpoint::SessionMark mark;
  mark.epoch = epoch_;
  mark.step = world_->stepCount();
  mark.sim_time = world_->time();
  mark.state_hash = world_->stateHash();
  mark.journal_number = channels_.journal.lastNumber();
  mark.speed_of_sound = world_->speedOfSound();
  mark.narrowest_wound = narrowest_wound_;
  mark.frame_rate = frame_clock_.rate();
  mark.attributes = attributes_;
  mark.paused = pacer_.paused();
  mark.next_force_key = next_force_key_;
  instruments_.mark(mark);
  return mark;
}

/// What install() does of a scene that begins, for one that goes on.
void Simulation::goOnFrom(const checkpoint::Head& head, TimePoint now) {
  const checkpoint::SessionMark& mark = head.mark;
  frame_clock_ = FrameClock{mark.frame_rate};
  frame_clock_.setRate(mark.frame_rate, world_->time());
  attributes_ = mark.attributes;
  narrowest_wound_ = mark.narrowest_wound;
  next_force_key_ = mark.next_force_key;
  instruments_.restore(mark, now);
  for (const sph::WoundState& wound : world_->wounds()) { wound_names_.set(wound.id, std::string{world_->woundName(wound.id)}); }
  record(dds::Restored{head.session, mark.epoch, mark.step, mark.journal_number, mark.state_hash, head.name});
}

}  // namespace bleedsim::daemon
