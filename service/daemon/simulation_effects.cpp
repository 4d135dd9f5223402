// Effects that are switched while the world runs: a second world is built beside it and takes over its state between two steps.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "service/daemon/simulation.h"

namespace bleedsim::daemon {

Status Simulation::switchingNow() const {
  if (pending_switch_->request) return {StatusCode::wrong_state, "an effect is being switched: wait for its reply"};
  return {StatusCode::wrong_state, "surface tension is being switched on for a wound: send this again in a moment"};
}

Status Simulation::startSwitching(const dds::SetEffect& set) {
  if (pending_load_) return {StatusCode::wrong_state, "a scene is being loaded: wait for its reply"};
  if (pending_switch_) return switchingNow();
  if (faulted_) return {StatusCode::wrong_state, "the solver has stopped on bad numbers: reset or load a scene first"};
  pending_switch_ = PendingSwitch{{}, narrowest_wound_};
  loader_.start(
      {{},
       scene_,
       EffectJob{scene::EffectChange{set.name, set.enabled, set.settings}, {world_->speedOfSound(), narrowest_wound_}}});
  return {};
}

void Simulation::finishSwitching() {
  if (!pending_switch_) return;
  std::optional<Result<LoadedScene>> finished = loader_.takeFinished();
  if (!finished) return;
  PendingSwitch pending = std::move(*pending_switch_);
  pending_switch_.reset();
  const std::vector<std::string> before = notes();
  Status outcome = finished->status();
  if (outcome && faulted_) outcome = {StatusCode::wrong_state, "the solver has stopped on bad numbers meanwhile"};
  if (outcome) outcome = takeOver(**finished);
  // What a replay cannot see of the requests: who asked for the switch, or what was known then.
  if (outcome && (!pending.request || pending.narrowest_wound != narrowest_wound_)) {
    record(dds::Switched{pending.narrowest_wound, pending.request.has_value()});
  }
  if (outcome && pending.request && pending.request->original) {
    record(dds::RequestTaken{std::move(pending.request->original), 0});
  }
  if (outcome) recordNewNotes(before);
  if (pending.request) answer(*pending.request, outcome, 0);
  // Freeing a world takes longer than a step.
  if (finished->ok()) loader_.retire(std::move((*finished)->world));
  // The new world was decided on before the wounds that came meanwhile.
  const bool narrower = outcome && callsForTension(narrowest_wound_);
  if (pending.request && !faulted_ && (narrower || anyCallsForTension())) {
    decideForWounds();
  } else {
    releaseWounds(outcome);
  }
  showState();
}

/// `next` takes the place of what runs, and holds the old world afterwards.
Status Simulation::takeOver(LoadedScene& next) {
  if (Status adopted = next.world->adopt(*world_); !adopted) return adopted;
  std::swap(world_, next.world);
  scene_ = std::move(next.scene);
  attributes_ &= availableAttributes();
  postScene();
  return {};
}

/// Into the journal, those that were not there before.
void Simulation::recordNewNotes(const std::vector<std::string>& before) {
  for (const std::string& note : notes()) {
    if (std::find(before.begin(), before.end(), note) == before.end()) record(dds::Decision{note});
  }
}

std::uint32_t Simulation::availableAttributes() const {
  std::uint32_t available = 0;
  for (const dds::FrameBlock& block : dds::kFrameBlocks) {
    if (block.effect.empty() || acts(block.effect)) available |= block.attribute;
  }
  return available;
}

bool Simulation::acts(std::string_view effect) const {
  return std::find(scene_->effects.begin(), scene_->effects.end(), effect) != scene_->effects.end();
}

/// What a person should know of the scene: warnings, then the decisions of effects.auto.
std::vector<std::string> Simulation::notes() const {
  std::vector<std::string> notes = scene_->warnings;
  notes.insert(notes.end(), scene_->decisions.begin(), scene_->decisions.end());
  return notes;
}

}  // namespace bleedsim::daemon
