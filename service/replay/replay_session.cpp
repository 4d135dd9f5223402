#include "service/replay/replay_session.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>

#include "service/build/build_info.h"
#include "service/checkpoint/rebuild.h"
#include "service/dds/decode.h"
#include "service/dds/overloaded.h"
#include "service/recording/convert.h"
#include "service/scene/change_effect.h"
#include "service/scene/feature_size.h"

namespace bleedsim::replay {
namespace {

constexpr std::uint64_t kFirstToolKey = std::uint64_t{1} << 63U;

/// Whether a request of that kind changes the world: all others act on the clock, on frames or on other epochs.
bool changesWorld(const recording::Request& request) {
  switch (request.body_case()) {
    case recording::Request::kWoundAdd:
    case recording::Request::kWoundUpdate:
    case recording::Request::kWoundRemove:
    case recording::Request::kForce:
    case recording::Request::kEffect:
      return true;
    default:
      return false;
  }
}

}  // namespace

ReplaySession::ReplaySession(std::shared_ptr<const scene::SceneDescription> scene, std::unique_ptr<sph::World> world,
                             const sph::WorldOptions& options)
    : scene_{std::move(scene)},
      world_{std::move(world)},
      options_{options},
      narrowest_wound_{std::numeric_limits<double>::infinity()},
      next_tool_key_{kFirstToolKey} {}

Result<ReplaySession> ReplaySession::begin(const std::string& scene_text, const sph::WorldOptions& options) {
  Result<scene::SceneDescription> scene = scene::parseScene(scene_text);
  if (!scene) return scene.status();
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(scene->world, options);
  if (!world) return world.status();
  return ReplaySession{std::make_shared<const scene::SceneDescription>(std::move(*scene)), std::move(*world), options};
}

Result<ReplaySession> ReplaySession::goOn(const Snapshot& snapshot, const sph::WorldOptions& options) {
  sph::WorldOptions same = options;
  same.speed_of_sound = snapshot.speed_of_sound;
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(snapshot.scene->world, same);
  if (!world) return world.status();
  if (Status restored = (*world)->restoreState(snapshot.state); !restored) return restored;
  ReplaySession session{snapshot.scene, std::move(*world), options};
  session.narrowest_wound_ = snapshot.narrowest_wound;
  session.next_force_key_ = snapshot.next_force_key;
  session.next_tool_key_ = snapshot.next_tool_key;
  session.tools_ = snapshot.tools;
  return session;
}

Result<ReplaySession> ReplaySession::goOn(const checkpoint::Checkpoint& checkpoint, const sph::WorldOptions& options) {
  // Whether the build is the same was judged by whoever verifies.
  Result<checkpoint::Rebuilt> rebuilt = checkpoint::rebuild(checkpoint, options, checkpoint.head.build_id);
  if (!rebuilt) return rebuilt.status();
  ReplaySession session{std::move(rebuilt->scene), std::move(rebuilt->world), options};
  const checkpoint::SessionMark& mark = checkpoint.head.mark;
  session.narrowest_wound_ = mark.narrowest_wound;
  session.next_force_key_ = mark.next_force_key;
  session.next_tool_key_ = std::max(mark.next_tool_key, kFirstToolKey);
  for (std::size_t i = 0; i < mark.tool_count; ++i) {
    const checkpoint::Tool& tool = mark.tools[i];
    const std::string client{reinterpret_cast<const char*>(tool.client.data()), tool.client.size()};
    session.tools_[{client, tool.tool}] = tool.force_key;
  }
  return session;
}

Snapshot ReplaySession::snapshot() const {
  Snapshot out{scene_,
               std::vector<std::byte>(world_->stateBytes()),
               world_->stateHash(),
               world_->speedOfSound(),
               narrowest_wound_,
               next_force_key_,
               next_tool_key_,
               tools_};
  out.state.resize(world_->saveState(out.state));
  return out;
}

Status ReplaySession::apply(const recording::Journal& entry) {
  switch (entry.body_case()) {
    case recording::Journal::kRequest:
      return changesWorld(entry.request().request()) ? applyRequest(entry) : Status{};
    case recording::Journal::kInstrument:
      return applyInstrument(entry);
    case recording::Journal::kInstrumentEnd:
      return endInstrument(entry.instrument_end());
    case recording::Journal::kSwitched: {
      const double narrowest = entry.switched().narrowest_wound_m();
      if (entry.switched().by_request()) {
        switch_narrowest_ = narrowest;
        return {};
      }
      return takeOver(scene::decideAgain(*scene_, {world_->speedOfSound(), narrowest}));
    }
    case recording::Journal::kDecision:  // for people
    case recording::Journal::kRestored:  // before the epoch's first step
    case recording::Journal::BODY_NOT_SET:
      break;
  }
  return {};
}

Status ReplaySession::applyRequest(const recording::Journal& entry) {
  const auto sample = recording::fromRecording(entry);
  if (!sample) return sample.status();
  const bleed_v1_RequestApplied& applied = (*sample)->body._u.request;
  Result<dds::Action> action = dds::decodeAction(applied.request.body);
  if (!action) return action.status();
  if (auto* add = std::get_if<sph::AddWound>(&*action)) {
    const Result<sph::Applied> added = world_->apply(*add);
    if (!added) return added.status();
    if (added->object_id != applied.object_id) {
      return {StatusCode::data_loss, fmt::format("the wound became {}, not {}", added->object_id, applied.object_id)};
    }
    narrowest_wound_ = std::min(narrowest_wound_, scene::patchWidthOf(*add));
    return {};
  }
  // By whatever the wound was named, the journal has its id.
  if (auto* update = std::get_if<sph::UpdateWound>(&*action)) {
    update->wound_id = applied.object_id;
    return command(*update);
  }
  if (std::holds_alternative<sph::RemoveWound>(*action)) return command(sph::RemoveWound{applied.object_id});
  if (const auto* push = std::get_if<dds::PushForce>(&*action)) {
    return command(sph::SetForce{next_force_key_++, push->position, push->radius, push->force, world_->time() + push->duration});
  }
  if (const auto* set = std::get_if<dds::SetEffect>(&*action)) {
    const double narrowest = std::exchange(switch_narrowest_, std::nullopt).value_or(narrowest_wound_);
    return takeOver(scene::changeEffect(*scene_, {set->name, set->enabled, set->settings}, {world_->speedOfSound(), narrowest}));
  }
  return {};
}

Status ReplaySession::command(const sph::Command& command) {
  const Result<sph::Applied> applied = world_->apply(command);
  if (!applied) return applied.status();
  narrowest_wound_ = std::min(narrowest_wound_, scene::patchWidthOf(command));
  return {};
}

Status ReplaySession::takeOver(Result<scene::SceneDescription> scene) {
  if (!scene) return scene.status();
  sph::WorldOptions same = options_;
  same.speed_of_sound = world_->speedOfSound();
  Result<std::unique_ptr<sph::World>> next = sph::createWorld(scene->world, same);
  if (!next) return next.status();
  if (Status adopted = (*next)->adopt(*world_); !adopted) return adopted;
  world_ = std::move(*next);
  scene_ = std::make_shared<const scene::SceneDescription>(std::move(*scene));
  return {};
}

Status ReplaySession::applyInstrument(const recording::Journal& entry) {
  const auto sample = recording::fromRecording(entry);
  if (!sample) return sample.status();
  const Result<dds::InstrumentSample> tool = dds::decodeInstrument((*sample)->body._u.instrument);
  if (!tool) return tool.status();
  const auto [known, fresh] = tools_.try_emplace({entry.instrument().client(), entry.instrument().tool()}, next_tool_key_);
  if (fresh) ++next_tool_key_;
  const Result<sph::Applied> applied = world_->apply(
      sph::SetForce{.key = known->second, .position = tool->position, .radius = tool->radius, .force = tool->force});
  return applied.status();
}

Status ReplaySession::endInstrument(const recording::InstrumentEnd& end) {
  const auto known = tools_.find({end.client(), end.tool()});
  if (known == tools_.end()) return {StatusCode::data_loss, "a tool ends that never pushed"};
  // A source that the world has dropped by itself, with an effect that went off, is gone already.
  static_cast<void>(world_->apply(sph::RemoveForce{known->second}));
  tools_.erase(known);
  return {};
}

}  // namespace bleedsim::replay
