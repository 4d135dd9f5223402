#include "tests/support/drops.h"

#include "service/lab/scene_parts.h"
#include "tests/support/scenes.h"

namespace bleedsim::test {

using sph::Vec3;

void addParticle(sph::WorldDescription& scene, const Vec3& position, const Vec3& velocity) {
  scene.fluid_blocks.push_back(lab::particleAt(scene.spacing, position, velocity));
}

void addBall(sph::WorldDescription& scene, const Vec3& center, double radius, const std::function<bool(const Vec3&)>& inside) {
  lab::forEachInBall(scene.spacing, center, radius, [&](const Vec3& at) {
    if (inside(at)) addParticle(scene, at);
  });
}

sph::WorldDescription restarted(const sph::World& world, const std::function<Vec3(const Vec3&)>& velocity) {
  sph::WorldDescription scene = world.description();
  scene.fluid_blocks.clear();
  const sph::FrameBuffer frame = frameOf(world);
  for (std::size_t i = 0; i < frame.count; ++i) addParticle(scene, positionOf(frame, i), velocity(positionOf(frame, i)));
  return scene;
}

}  // namespace bleedsim::test
