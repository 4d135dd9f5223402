// Effects that are switched while the world runs: a second world is built beside it and takes over its state between two steps.
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "service/daemon/simulation.h"

namespace bleedsim::daemon {

Status Simulation::startSwitching(const dds::SetEffect& set) {
  if (pending_load_) return {StatusCode::wrong_state, "a scene is being loaded: wait for its reply"};
  if (pending_effect_) return {StatusCode::wrong_state, "another effect is being switched: wait for its reply"};
  if (faulted_) return {StatusCode::wrong_state, "the solver has stopped on bad numbers: reset or load a scene first"};
  pending_effect_.emplace();
  loader_.start({{}, scene_, EffectJob{{set.name, set.enabled, set.settings}, world_->speedOfSound()}});
  return {};
}

void Simulation::finishSwitching() {
  if (!pending_effect_) return;
  std::optional<Result<LoadedScene>> finished = loader_.takeFinished();
  if (!finished) return;
  dds::DecodedRequest request = std::move(*pending_effect_);
  pending_effect_.reset();
  Status outcome = finished->status();
  if (outcome && faulted_) outcome = {StatusCode::wrong_state, "the solver has stopped on bad numbers meanwhile"};
  if (outcome) outcome = (*finished)->world->adopt(*world_);
  if (outcome) {
    const std::vector<std::string> before = scene_->decisions;
    std::swap(world_, (*finished)->world);
    scene_ = std::move((*finished)->scene);
    attributes_ &= availableAttributes();
    postScene();
    if (request.original) record(dds::RequestTaken{std::move(request.original), 0});
    for (const std::string& decision : scene_->decisions) {
      if (std::find(before.begin(), before.end(), decision) == before.end()) record(dds::Decision{decision});
    }
  }
  answer(request, outcome, 0);
  // Freeing a world takes longer than a step.
  if (finished->ok()) loader_.retire(std::move((*finished)->world));
  showState();
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

std::string Simulation::note() const {
  if (!fault_text_.empty()) return fault_text_;
  return fmt::format("{}", fmt::join(scene_->decisions, "; "));
}

}  // namespace bleedsim::daemon
