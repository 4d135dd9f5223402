// Requests: each is carried out between two steps and answered.
#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "service/daemon/simulation.h"
#include "service/daemon/wound_commands.h"
#include "service/dds/command_limits.h"
#include "service/dds/overloaded.h"
#include "service/scene/feature_size.h"

namespace bleedsim::daemon {
namespace {

// So that a flood of inputs cannot keep the world from stepping.
constexpr std::size_t kInputsPerStep = 128;

Status loadingNow() { return {StatusCode::wrong_state, "a scene is being loaded: wait for its reply"}; }
Status faultedNow() { return {StatusCode::wrong_state, "the solver has stopped on bad numbers: reset or load a scene first"}; }

}  // namespace

bool Simulation::drainInputs(TimePoint now) {
  for (std::size_t i = 0; i < kInputsPerStep; ++i) {
    if (ended_ || channels_.replies.room() < Channels::kRepliesOfSimulation || !channels_.commands.tryPop(input_)) return false;
    std::visit(dds::Overloaded{[&](dds::DecodedRequest& request) { carryOut(request, now); },
                               [&](InstrumentInput& sample) { takeSample(sample, now); },
                               [&](const WriterLost& lost) { loseWriter(lost.writer, now); }},
               input_);
  }
  return !ended_ && !channels_.commands.empty();
}

void Simulation::loseWriter(std::uint64_t writer, TimePoint now) {
  endInstrumentsOf(writer);
  if (lease_.loseWriter(writer, now)) showState();
}

void Simulation::carryOut(dds::DecodedRequest& request, TimePoint now) {
  if (lease_.bars(request.key.origin.client, now)) {
    answer(request, leasedToOther(now), 0);
    return;
  }
  if (holdWound(request)) return;
  const bool was_loading = pending_load_.has_value();
  const bool was_switching = pending_switch_.has_value();
  const Result<sph::Applied> done = perform(request, now);
  if (done && !was_loading && pending_load_) {
    pending_load_->request = std::move(request);
    showState();
    return;
  }
  if (done && !was_switching && pending_switch_) {
    pending_switch_->request = std::move(request);
    return;
  }
  if (done && std::holds_alternative<dds::SaveCheckpoint>(request.action)) {
    asked_checkpoint_ = std::move(request);
    return;
  }
  settle(request, done);
}

void Simulation::settle(dds::DecodedRequest& request, const Result<sph::Applied>& done) {
  const std::uint32_t object_id = done ? done->object_id : 0;
  answer(request, done.status(), object_id);
  if (done && request.original) record(dds::RequestTaken{std::move(request.original), object_id});
}

Result<sph::Applied> Simulation::perform(dds::DecodedRequest& request, TimePoint now) {
  const auto running_only = [this]() -> Status {
    if (pending_load_) return loadingNow();
    if (faulted_) return faultedNow();
    return {};
  };
  return std::visit(
      dds::Overloaded{
          [&](const dds::Ping&) -> Result<sph::Applied> { return sph::Applied{}; },
          [&](const sph::AddWound& add) { return applyToWorld(add); },
          [&](const sph::UpdateWound& update) { return applyToNamed(update, request.wound_name); },
          [&](const sph::RemoveWound& remove) { return applyToNamed(remove, request.wound_name); },
          [&](const dds::PushForce& push) {
            return applyToWorld(
                sph::SetForce{next_force_key_++, push.position, push.radius, push.force, world_->time() + push.duration});
          },
          [&](const dds::PauseSession&) -> Result<sph::Applied> {
            if (Status possible = running_only(); !possible) return possible;
            steps_left_ = 0;
            pacer_.pause(now, world_->time());
            showState();
            return sph::Applied{};
          },
          [&](const dds::ResumeSession&) -> Result<sph::Applied> {
            if (Status possible = running_only(); !possible) return possible;
            steps_left_ = 0;
            pacer_.resume(now, world_->time());
            showState();
            return sph::Applied{};
          },
          [&](const dds::ResetSession&) -> Result<sph::Applied> {
            if (Status started = startLoading({{}, loaded_scene_}, true, now); !started) return started;
            return sph::Applied{};
          },
          [&](const dds::StepSession& step) -> Result<sph::Applied> {
            if (Status possible = running_only(); !possible) return possible;
            if (!pacer_.paused()) return Status{StatusCode::wrong_state, "the session is running: pause it before stepping"};
            if (step.count > dds::kMaxStepCount - steps_left_) {
              return Status{StatusCode::capacity, fmt::format("{} steps are still to be done: wait for them", steps_left_)};
            }
            steps_left_ += step.count;
            return sph::Applied{};
          },
          [&](const dds::SetPace& set) -> Result<sph::Applied> {
            pacer_.setPace(set.pace, now, world_->time());
            showState();
            return sph::Applied{};
          },
          [&](const dds::SetOutput& output) { return setOutput(output); },
          [&](dds::LoadScene& load) -> Result<sph::Applied> {
            if (Status started = startLoading({std::move(load.text), {}}, false, now); !started) return started;
            return sph::Applied{};
          },
          [&](const dds::SetEffect& set) -> Result<sph::Applied> {
            if (Status started = startSwitching(set); !started) return started;
            return sph::Applied{};
          },
          [&](const dds::AcquireLease&) { return acquireLease(request, now); },
          [&](const dds::ReleaseLease&) { return releaseLease(request, now); },
          [&](const dds::SaveCheckpoint&) -> Result<sph::Applied> {
            if (Status possible = wantCheckpoint(); !possible) return possible;
            return sph::Applied{};
          },
          [&](const dds::RestoreCheckpoint& restore) -> Result<sph::Applied> {
            if (Status started = startRestoring(restore.name, now); !started) return started;
            return sph::Applied{};
          },
          [&](const dds::ShutdownSession&) -> Result<sph::Applied> {
            ended_ = true;
            return sph::Applied{};
          },
      },
      request.action);
}

Result<sph::Applied> Simulation::applyToWorld(const sph::Command& command) {
  if (pending_load_) return loadingNow();
  if (faulted_) return faultedNow();
  const std::size_t wounds_before = world_->wounds().size();
  Result<sph::Applied> applied = world_->apply(command);
  if (applied) {
    narrowest_wound_ = std::min(narrowest_wound_, scene::patchWidthOf(command));
    noteWoundName(command, applied->object_id);
  }
  if (world_->wounds().size() != wounds_before) showState();
  return applied;
}

Result<sph::Applied> Simulation::applyToNamed(sph::Command command, const std::string& wound_name) {
  if (Status found = nameWound(command, wound_name); !found) return found;
  return applyToWorld(command);
}

/// Puts the id into a command that tells its wound by the name.
Status Simulation::nameWound(sph::Command& command, const std::string& wound_name) const {
  if (wound_name.empty()) return {};
  const std::optional<std::uint32_t> id = wound_names_.find(wound_name);
  if (!id) { return {StatusCode::not_found, fmt::format("there is no wound named '{}'", wound_name)}; }
  if (auto* update = std::get_if<sph::UpdateWound>(&command)) update->wound_id = *id;
  if (auto* remove = std::get_if<sph::RemoveWound>(&command)) remove->wound_id = *id;
  return {};
}

void Simulation::noteWoundName(const sph::Command& command, std::uint32_t id) {
  if (const auto* add = std::get_if<sph::AddWound>(&command)) wound_names_.set(id, add->wound.name);
  const auto* update = std::get_if<sph::UpdateWound>(&command);
  if (update != nullptr && update->name) wound_names_.set(id, *update->name);
  if (const auto* remove = std::get_if<sph::RemoveWound>(&command)) wound_names_.forget(remove->wound_id);
}

Status Simulation::startLoading(SceneJob job, bool reset, TimePoint now) {
  if (pending_load_) return loadingNow();
  if (pending_switch_) return switchingNow();
  // A world that stopped on bad numbers is paused by that alone: what replaces it runs.
  const bool stay_paused = pacer_.paused() && !faulted_;
  pending_load_.emplace(PendingLoad{{}, reset, stay_paused, faulted_});
  pacer_.pause(now, world_->time());
  loader_.start(std::move(job));
  return {};
}

Result<sph::Applied> Simulation::setOutput(const dds::SetOutput& output) {
  if (pending_load_) return loadingNow();
  for (const dds::FrameBlock& block : dds::kFrameBlocks) {
    if (!output.attributes || (*output.attributes & block.attribute & ~availableAttributes()) == 0) continue;
    return Status{StatusCode::unsupported,
                  fmt::format("output.attributes asks for {}, but the session has no {} effect: leave the bit out", block.name,
                              block.effect)};
  }
  if (output.attributes) attributes_ = *output.attributes;
  if (output.frame_rate) frame_clock_.setRate(*output.frame_rate, world_->time());
  showState();
  return sph::Applied{};
}

void Simulation::answerLoad(PendingLoad& load, const Status& status) {
  dds::Reply reply;
  reply.key = load.request.key;
  reply.applied_step = status ? 0 : world_->stepCount() + 1;
  reply.sim_time = world_->time();
  reply.epoch = epoch_;
  reply.receive_stamp_ns = load.request.receive_stamp_ns;
  reply.reason = status.message();
  if (status && std::holds_alternative<dds::RestoreCheckpoint>(load.request.action)) {
    reply.object_name = load.checkpoint;
    reply.applied_step = world_->stepCount() + 1;
  }
  if (!status && std::holds_alternative<dds::RestoreCheckpoint>(load.request.action)) {
    reply.code = dds::replyCode(status.code());
  } else if (!status) {
    reply.code = load.reset || status.code() == StatusCode::internal ? dds::ReplyCode::failed : dds::ReplyCode::scene;
  }
  send(std::move(reply));
  if (status && load.request.original) record(dds::RequestTaken{std::move(load.request.original), 0});
}

void Simulation::answer(const dds::DecodedRequest& request, const Status& status, std::uint32_t object_id) {
  send(replyTo(request, status, object_id));
}

dds::Reply Simulation::replyTo(const dds::DecodedRequest& request, const Status& status, std::uint32_t object_id) const {
  dds::Reply reply;
  reply.key = request.key;
  reply.code = dds::replyCode(status.code());
  reply.applied_step = world_->stepCount() + 1;
  reply.sim_time = world_->time();
  reply.epoch = epoch_;
  reply.object_id = object_id;
  reply.reason = status.message();
  reply.receive_stamp_ns = request.receive_stamp_ns;
  if (const auto* ping = std::get_if<dds::Ping>(&request.action)) reply.client_stamp_ns = ping->client_stamp_ns;
  return reply;
}

void Simulation::send(dds::Reply reply) {
  if (reply.code != dds::ReplyCode::accepted) {
    channels_.counters.add(ServiceCounter::requests_refused);
    channels_.clients.note(reply.key.origin.client, dds::ClientCount::refused);
  }
  if (!channels_.replies.tryPush(std::move(reply))) {
    channels_.counters.add(ServiceCounter::replies_lost);
    // For the client that sends its request again. NOLINTNEXTLINE(bugprone-use-after-move): a refused value is not moved from
    channels_.reply_cache.finish(reply);
  }
  channels_.publisher.notify();
}

}  // namespace bleedsim::daemon
