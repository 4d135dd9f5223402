// Wounds by command that are narrow enough to need surface tension where effects.auto has left it out. Such a command waits, and
// those of wounds after it, until a world with tension is built beside the one that runs; it acts at the step boundary at which
// that world takes over.
#include <algorithm>
#include <fmt/format.h>

#include "service/daemon/simulation.h"

namespace bleedsim::daemon {

bool Simulation::callsForTension(double width) const { return scene_->tension_below > 0.0 && width <= scene_->tension_below; }

bool Simulation::anyCallsForTension() const {
  return std::any_of(waiting_wounds_.begin(), waiting_wounds_.end(),
                     [this](const WaitingWound& waiting) { return callsForTension(waiting.wound.width); });
}

/// Takes the request, to hold or to refuse it, if it is a wound's that cannot be carried out at once.
bool Simulation::holdWound(dds::DecodedRequest& request) {
  if (pending_load_ || faulted_) return false;  // to be refused
  if (waiting_wounds_.empty() && scene_->tension_below <= 0.0) return false;
  std::optional<WoundCommand> wound = woundCommand(request.action);
  if (!wound || (waiting_wounds_.empty() && !callsForTension(wound->width))) return false;
  Status possible;
  if (waiting_wounds_.size() >= Channels::kMaxWaitingWounds) {
    possible = {StatusCode::capacity, fmt::format("{} wound commands wait for surface tension already: wait for their replies",
                                                  waiting_wounds_.size())};
  } else if (waiting_wounds_.empty()) {
    possible = nameWound(wound->command, request.wound_name);
    if (possible) possible = world_->checkWound(wound->command);  // a wound that will not open switches nothing
  }
  if (!possible) {
    answer(request, possible, 0);
    return true;
  }
  waiting_wounds_.push_back({std::move(request), std::move(*wound)});
  if (!pending_switch_) decideForWounds();
  return true;
}

void Simulation::decideForWounds() {
  scene::Session session{world_->speedOfSound(), narrowest_wound_};
  for (const WaitingWound& waiting : waiting_wounds_) {
    session.narrowest_wound = std::min(session.narrowest_wound, waiting.wound.width);
  }
  pending_switch_ = PendingSwitch{{}, session.narrowest_wound};
  loader_.start({{}, scene_, EffectJob{std::nullopt, session}});
}

/// `switched`: how the switch to surface tension went. Commands that can do without it act in any case.
void Simulation::releaseWounds(const Status& switched) {
  for (WaitingWound& waiting : std::exchange(waiting_wounds_, {})) {
    if (!switched && callsForTension(waiting.wound.width)) {
      settle(waiting.request, Status{switched.code(), fmt::format("no surface tension for this wound: {}", switched.message())});
    } else {
      settle(waiting.request, applyToNamed(waiting.wound.command, waiting.request.wound_name));
    }
  }
}

}  // namespace bleedsim::daemon
