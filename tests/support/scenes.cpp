#include "tests/support/scenes.h"

#include <algorithm>
#include <stdexcept>

#include "service/lab/frame_vectors.h"
#include "service/lab/scene_parts.h"

namespace bleedsim::test {
namespace {

using sph::Vec3;

Vec3 extentOf(const Counts& counts) { return lab::extentOf(kSpacing, counts); }

void addBlood(sph::WorldDescription& scene, const Vec3& lower, const Counts& counts, double jitter) {
  scene.fluid_blocks.push_back(lab::blockOf(kSpacing, lower, counts));
  scene.fluid_blocks.back().jitter = jitter;
  scene.capacity = std::max(scene.capacity, static_cast<std::uint32_t>(counts[0] * counts[1] * counts[2]));
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
}

void addBox(sph::WorldDescription& scene, const Vec3& upper, bool open_top) {
  sph::BoxShape box;
  box.upper = upper;
  box.open_top = open_top;
  scene.tissue.push_back({.name = "box", .shape = box});
  scene.domain.lower = Vec3::Constant(-0.02);
  scene.domain.upper = upper + Vec3::Constant(0.02);
}

}  // namespace

sph::WorldDescription emptyScene() {
  sph::WorldDescription scene;
  scene.capacity = 20'000;
  scene.spacing = kSpacing;
  scene.support_ratio = 2.0;
  scene.rest_density = kRestDensity;
  scene.compressibility.design_speed = 0.5;
  return scene;
}

sph::WorldDescription freeBlock(const Counts& counts, double jitter) {
  sph::WorldDescription scene = emptyScene();
  addBlood(scene, -0.5 * extentOf(counts), counts, jitter);
  return scene;
}

sph::WorldDescription closedBox(const Counts& counts, double jitter) {
  sph::WorldDescription scene = emptyScene();
  addBlood(scene, Vec3::Zero(), counts, jitter);
  addBox(scene, extentOf(counts), false);
  return scene;
}

sph::WorldDescription periodicBox(const Counts& counts, double jitter) {
  sph::WorldDescription scene = emptyScene();
  addBlood(scene, Vec3::Zero(), counts, jitter);
  scene.domain.lower = Vec3::Zero();
  scene.domain.upper = extentOf(counts);
  scene.domain.periodic = {true, true, true};
  return scene;
}

sph::WorldDescription hydrostaticColumn(const Counts& counts, double viscosity) {
  sph::WorldDescription scene = emptyScene();
  addBlood(scene, Vec3::Zero(), counts, 0.0);
  addBox(scene, extentOf(counts), true);
  scene.effects.viscosity->viscosity = viscosity;
  scene.effects.gravity.emplace();
  scene.compressibility.max_fall_or_depth = kSpacing * counts[2];
  return scene;
}

sph::WoundDescription discWound(double radius, double flow) { return lab::discWound(radius, flow); }

sph::WorldDescription woundOnPlane(double radius, double flow) {
  sph::WorldDescription scene = emptyScene();
  scene.domain.lower.z() = -0.01;
  scene.tissue.push_back({.name = "plane", .shape = sph::PlaneShape{}});
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.gravity.emplace();
  scene.wounds.push_back(discWound(radius, flow));
  return scene;
}

std::unique_ptr<sph::World> makeWorld(const sph::WorldDescription& description, const sph::WorldOptions& options) {
  auto world = sph::createWorld(description, options);
  if (!world) throw std::runtime_error{world.status().message()};
  return std::move(*world);
}

sph::WorldStats statsOf(const sph::World& world) { return lab::statsOf(world); }

std::uint64_t counterOf(const sph::World& world, sph::Counter counter) {
  return statsOf(world).counters[static_cast<std::size_t>(counter)];
}

sph::FrameBuffer frameOf(const sph::World& world) {
  constexpr std::uint32_t kAll =
      sph::kFrameVelocity | sph::kFrameDensity | sph::kFrameViscosity | sph::kFramePlatelet | sph::kFrameRadius;
  sph::FrameBuffer frame;
  frame.reserve(world.description().capacity, kAll);
  world.copyFrame(frame, kAll);
  frame.position.resize(3 * std::size_t{frame.count});
  frame.velocity.resize(3 * std::size_t{frame.count});
  frame.id.resize(frame.count);
  frame.density.resize(frame.count);
  frame.viscosity.resize(frame.count);
  frame.platelet.resize(frame.count);
  frame.radius.resize(frame.count);
  return frame;
}

sph::Vec3 positionOf(const sph::FrameBuffer& frame, std::size_t particle) { return lab::positionOf(frame, particle); }

sph::Vec3 velocityOf(const sph::FrameBuffer& frame, std::size_t particle) { return lab::velocityOf(frame, particle); }

sph::Vec3 momentumOf(const sph::World& world) {
  const sph::FrameBuffer frame = frameOf(world);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < frame.count; ++i) sum += velocityOf(frame, i);
  return world.particleMass() * sum;
}

double momentumScaleOf(const sph::World& world) { return lab::momentumScale(world, frameOf(world)); }

}  // namespace bleedsim::test
