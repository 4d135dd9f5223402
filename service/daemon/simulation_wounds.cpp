// Wounds by command that are narrow enough to need surface tension where effects.auto has left it out. Such a command waits, and
// those of wounds after it, until a world with tension is built beside the one that runs; it acts at the step boundary at which
// that world takes over.
#include <algorithm>
#include <fmt/format.h>

#include "service/daemon/simulation.h"
#include "service/daemon/wound_commands.h"

namespace bleedsim::daemon {
namespace {

constexpr std::size_t kMaxWaiting = 64;

}  // namespace

bool Simulation::mustWait(const dds::DecodedRequest& request) const {
  if (pending_load_ || faulted_) return false;  // to be refused
  const std::optional<sph::Command> command = woundCommand(request.action);
  return command && (!waiting_wounds_.empty() || callsForTension(*command));
}

bool Simulation::callsForTension(const sph::Command& command) const {
  return scene_->tension_below > 0.0 && patchWidthOf(command) <= scene_->tension_below;
}

bool Simulation::anyCallsForTension() const {
  return std::any_of(waiting_wounds_.begin(), waiting_wounds_.end(),
                     [this](const dds::DecodedRequest& request) { return callsForTension(*woundCommand(request.action)); });
}

void Simulation::holdWound(dds::DecodedRequest request) {
  Status possible;
  if (waiting_wounds_.size() >= kMaxWaiting) {
    possible = {StatusCode::capacity, fmt::format("{} wound commands wait for surface tension already: wait for their replies",
                                                  waiting_wounds_.size())};
  } else if (waiting_wounds_.empty()) {
    possible = world_->checkWound(*woundCommand(request.action));  // a wound that will not open switches nothing
  }
  if (!possible) {
    answer(request, possible, 0);
    return;
  }
  waiting_wounds_.push_back(std::move(request));
  if (!pending_switch_) decideForWounds();
}

void Simulation::decideForWounds() {
  scene::Session session{world_->speedOfSound(), narrowest_wound_};
  for (const dds::DecodedRequest& request : waiting_wounds_) {
    session.narrowest_wound = std::min(session.narrowest_wound, patchWidthOf(*woundCommand(request.action)));
  }
  pending_switch_.emplace();
  loader_.start({{}, scene_, EffectJob{std::nullopt, session}});
}

/// `switched`: how the switch to surface tension went. Commands that can do without it act in any case.
void Simulation::releaseWounds(const Status& switched) {
  for (dds::DecodedRequest& request : std::exchange(waiting_wounds_, {})) {
    const sph::Command command = *woundCommand(request.action);
    if (!switched && callsForTension(command)) {
      settle(request, Status{switched.code(), fmt::format("no surface tension for this wound: {}", switched.message())});
    } else {
      settle(request, applyToWorld(command));
    }
  }
}

}  // namespace bleedsim::daemon
