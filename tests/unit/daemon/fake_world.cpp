#include "tests/unit/daemon/fake_world.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace bleedsim::daemon {
namespace {

LoadedScene build(std::shared_ptr<const scene::SceneDescription> scene, std::shared_ptr<FakeLog> log) {
  auto world = std::make_unique<FakeWorld>(scene->world, std::move(log));
  FrameMailbox::Buffers frames = FrameMailbox::makeBuffers(scene->world.capacity);
  return {std::move(scene), std::move(world), std::move(frames)};
}

Result<LoadedScene> decided(const SceneJob& job, std::shared_ptr<FakeLog> log) {
  if (job.known->name == "stuck") return Status{StatusCode::internal, "no memory for another world"};
  auto scene = std::make_shared<scene::SceneDescription>(*job.known);
  scene->effects.emplace_back("surface_tension");
  scene->decisions = {"auto: surface_tension on"};
  scene->tension_below = 0.0;
  return build(std::move(scene), std::move(log));
}

Result<LoadedScene> switched(const SceneJob& job, std::shared_ptr<FakeLog> log) {
  log->session = job.effect->session;
  if (!job.effect->change) return decided(job, std::move(log));
  const scene::EffectChange& change = *job.effect->change;
  if (change.settings == "bad") return Status{StatusCode::invalid_argument, "effects.x: value bad"};
  auto scene = std::make_shared<scene::SceneDescription>(*job.known);
  std::erase(scene->effects, change.name);
  if (change.enabled) scene->effects.push_back(change.name);
  scene->normalized_text += (change.enabled ? "+" : "-") + change.name;
  if (change.settings == "decide") scene->decisions.emplace_back("auto: decided");
  return build(std::move(scene), std::move(log));
}

}  // namespace

FakeWorld::FakeWorld(sph::WorldDescription description, std::shared_ptr<FakeLog> log)
    : description_{std::move(description)}, log_{std::move(log)} {}

Status FakeWorld::checkWound(const sph::Command&) const {
  return log_->refuse_wounds ? Status{StatusCode::invalid_argument, "the fake world bears no wounds"} : Status{};
}

// The number of steps and of wounds is all that a fake world has.
std::size_t FakeWorld::saveState(std::span<std::byte> room) const {
  const std::array<std::uint64_t, 2> state{steps_, wounds_.size()};
  if (room.size() < sizeof state || faulted_) return 0;
  std::memcpy(room.data(), state.data(), sizeof state);
  return sizeof state;
}

Status FakeWorld::restoreState(std::span<const std::byte> bytes) {
  std::array<std::uint64_t, 2> state{};
  if (bytes.size() != sizeof state) return {StatusCode::data_loss, "no state of a fake world"};
  std::memcpy(state.data(), bytes.data(), sizeof state);
  steps_ = state[0];
  wounds_.clear();
  while (wounds_.size() < state[1]) wounds_.push_back({static_cast<std::uint32_t>(wounds_.size() + 1), 0.0, 0.0});
  return {};
}

std::string_view FakeWorld::woundName(std::uint32_t id) const { return id == 1 ? "first" : ""; }

Result<sph::Applied> FakeWorld::apply(const sph::Command& command) {
  log_->applied.emplace_back(steps_, command);
  if (const auto* force = std::get_if<sph::SetForce>(&command)) {
    if (force->force.norm() > 1000.0) return Status{StatusCode::capacity, "more than the fake world bears: use less"};
    log_->forces[force->key] = *force;
    return sph::Applied{};
  }
  if (const auto* removed = std::get_if<sph::RemoveForce>(&command)) {
    log_->forces.erase(removed->key);
    return sph::Applied{};
  }
  if (Status possible = checkWound(command); !possible) return possible;
  if (std::holds_alternative<sph::AddWound>(command)) {
    wounds_.push_back({static_cast<std::uint32_t>(wounds_.size() + 1), 0.0, 0.0});
    return sph::Applied{wounds_.back().id};
  }
  const auto* remove = std::get_if<sph::RemoveWound>(&command);
  if (remove != nullptr) {
    const auto removed = std::erase_if(wounds_, [remove](const sph::WoundState& wound) { return wound.id == remove->wound_id; });
    if (removed > 0) return sph::Applied{remove->wound_id};
  }
  return Status{StatusCode::not_found, "no such wound: use an id of frame_stats"};
}

Status FakeWorld::step(double dt_limit) {
  if (!(dt_limit > 0.0)) return {StatusCode::invalid_argument, "dt_limit must be positive"};
  if (log_->before_step) log_->before_step(steps_ + 1);
  if (steps_ + 1 == log_->fail_at_step) {
    faulted_ = true;
    return {StatusCode::internal, "particle 1 is not finite"};
  }
  ++steps_;
  return {};
}

void FakeWorld::collectStats(sph::WorldStats& stats) const {
  stats = {};
  stats.step = steps_;
  stats.time = time();
  stats.dt = kDt;
  stats.particles = 2;
}

void FakeWorld::copyFrame(sph::FrameBuffer& frame, std::uint32_t attributes) const {
  frame.step = steps_;
  frame.time = time();
  frame.count = 2;
  frame.attributes = attributes;
}

Status FakeWorld::adopt(sph::World& from) {
  if (log_->refuse_adoption) return {StatusCode::capacity, "the fake world has no room"};
  const auto& other = dynamic_cast<const FakeWorld&>(from);
  steps_ = other.steps_;
  wounds_ = other.wounds_;
  ++log_->adoptions;
  return {};
}

LoadedScene fakeScene(const std::string& name, std::shared_ptr<FakeLog> log) {
  auto scene = std::make_shared<scene::SceneDescription>();
  scene->name = name;
  scene->normalized_text = name;
  scene->frame_rate = 10.0;
  scene->world.capacity = 8;
  if (name == "no tension" || name == "stuck") {
    scene->tension_below = 0.005;
    scene->decisions = {"auto: surface_tension off"};
  }
  return build(std::move(scene), std::move(log));
}

SceneFactory fakeFactory(std::shared_ptr<FakeLog> log) {
  return [log = std::move(log)](const SceneJob& job) -> Result<LoadedScene> {
    if (job.effect) return switched(job, log);
    if (job.known) return build(job.known, log);
    if (job.text == "broken") return Status{StatusCode::invalid_argument, "domain: missing, give the box"};
    return fakeScene(job.text, log);
  };
}

}  // namespace bleedsim::daemon
