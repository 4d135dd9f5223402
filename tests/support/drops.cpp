#include "tests/support/drops.h"

#include <cmath>

#include "tests/support/scenes.h"

namespace bleedsim::test {

using sph::Vec3;

void addParticle(sph::WorldDescription& scene, const Vec3& position, const Vec3& velocity) {
  sph::FluidBlock block;
  block.lower = position - Vec3::Constant(0.5 * scene.spacing);
  block.upper = position + Vec3::Constant(0.5 * scene.spacing);
  block.velocity = velocity;
  scene.fluid_blocks.push_back(block);
}

void addBall(sph::WorldDescription& scene, const Vec3& center, double radius, const std::function<bool(const Vec3&)>& inside) {
  const int reach = static_cast<int>(std::ceil(radius / scene.spacing));
  for (int z = -reach; z < reach; ++z) {
    for (int y = -reach; y < reach; ++y) {
      for (int x = -reach; x < reach; ++x) {
        const Vec3 offset = scene.spacing * Vec3{x + 0.5, y + 0.5, z + 0.5};
        if (offset.norm() <= radius && inside(center + offset)) addParticle(scene, center + offset);
      }
    }
  }
}

sph::WorldDescription restarted(const sph::World& world, const std::function<Vec3(const Vec3&)>& velocity) {
  sph::WorldDescription scene = world.description();
  scene.fluid_blocks.clear();
  const sph::FrameBuffer frame = frameOf(world);
  for (std::size_t i = 0; i < frame.count; ++i) addParticle(scene, positionOf(frame, i), velocity(positionOf(frame, i)));
  return scene;
}

}  // namespace bleedsim::test
