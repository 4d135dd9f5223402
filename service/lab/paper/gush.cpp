#include "service/lab/paper/gush.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace bleedsim::lab {
namespace {

constexpr std::uint32_t kThroatRoom = 8000;  // unseen particles behind the wounds

}  // namespace

Result<Gush> Gush::create(sph::WorldDescription scene, const sph::WorldOptions& options, std::uint32_t particles) {
  if (scene.wounds.empty()) return Status{StatusCode::invalid_argument, "the scene needs a wound"};
  scene.capacity = std::max(scene.capacity, particles + kThroatRoom);
  auto world = sph::createWorld(scene, options);
  if (!world) return world.status();
  return Gush{std::move(*world), scene.capacity};
}

Gush::Gush(std::unique_ptr<sph::World> world, std::uint32_t capacity) : world_{std::move(world)} {
  frame_.reserve(capacity, sph::kFrameVelocity | sph::kFramePlatelet);
}

std::uint32_t Gush::emitted() const {
  double volume = 0.0;
  for (const sph::WoundState& wound : world_->wounds()) volume += wound.emitted;
  return static_cast<std::uint32_t>(std::lround(volume / world_->description().particleVolume()));
}

Status Gush::growTo(std::uint32_t particles) {
  double flow = 0.0;
  for (const sph::WoundState& wound : world_->wounds()) flow += wound.flow;
  const double needed = particles * world_->description().particleVolume() / flow;
  while (emitted() < particles) {
    if (!(world_->time() <= 3.0 * needed)) {
      return {StatusCode::timed_out,
              fmt::format("only {} of {} particles came after {:.3g} s", emitted(), particles, world_->time())};
    }
    if (Status status = world_->step(std::numeric_limits<double>::infinity()); !status.ok()) {
      return {status.code(), fmt::format("at {:.4g} s with {} particles: {}", world_->time(), present(), status.message())};
    }
  }
  return {};
}

GushBody Gush::body() {
  world_->copyFrame(frame_, sph::kFrameVelocity);
  const std::size_t numbers = 3 * std::size_t{frame_.count};
  return {{frame_.position.data(), numbers}, {frame_.velocity.data(), numbers}};
}

std::optional<double> Gush::plateletChange() {
  const std::optional<sph::PlateletSettings>& platelets = world_->description().effects.platelets;
  if (!platelets) return std::nullopt;
  world_->copyFrame(frame_, sph::kFramePlatelet);
  double change = 0.0;
  for (std::size_t i = 0; i < frame_.count; ++i)
    change = std::max(change, std::abs(static_cast<double>(frame_.platelet[i]) - platelets->fresh));
  return change;
}

}  // namespace bleedsim::lab
