#include "service/lab/hardcases/case_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bleedsim::lab {

sph::WorldDescription emptyScene() {
  sph::WorldDescription scene;
  scene.spacing = kCaseSpacing;
  scene.capacity = 4000;
  scene.compressibility.design_speed = 0.5;
  return scene;
}

sph::WorldDescription bloodScene() {
  sph::WorldDescription scene = emptyScene();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  return scene;
}

sph::WorldDescription weightlessScene() {
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity = sph::GravitySettings{sph::Vec3::Zero()};
  return scene;
}

void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts, const sph::Vec3& velocity) {
  scene.fluid_blocks.push_back(blockOf(scene.spacing, lower, counts));
  scene.fluid_blocks.back().velocity = velocity;
}

void addLoneParticle(sph::WorldDescription& scene, const sph::Vec3& at, const sph::Vec3& velocity) {
  scene.fluid_blocks.push_back(particleAt(scene.spacing, at, velocity));
}

void addBox(sph::WorldDescription& scene, const Counts& counts, bool open_top) {
  sph::BoxShape box;
  box.upper = extentOf(scene.spacing, counts);
  box.open_top = open_top;
  scene.tissue.push_back({.name = "box", .shape = box});
  scene.domain.lower = sph::Vec3::Constant(-20.0 * scene.spacing);
  scene.domain.upper = box.upper + sph::Vec3::Constant(20.0 * scene.spacing);
}

void addPlane(sph::WorldDescription& scene, const sph::Vec3& point, const sph::Vec3& normal) {
  sph::PlaneShape plane;
  plane.point = point;
  plane.normal = normal;
  scene.tissue.push_back({.name = "plane" + std::to_string(scene.tissue.size()), .shape = plane});
}

sph::WorldDescription poolScene(const Counts& box, int depth) {
  sph::WorldDescription scene = bloodScene();
  addBox(scene, box);
  addBlock(scene, sph::Vec3::Zero(), {box[0], box[1], depth});
  scene.effects.gravity.emplace();
  scene.effects.applied_force.emplace();
  scene.compressibility.max_fall_or_depth = box[2] * scene.spacing;
  return scene;
}

sph::WorldDescription woundScene(double radius, double flow) {
  sph::WorldDescription scene = bloodScene();
  scene.effects.gravity.emplace();
  scene.domain.lower.z() = -0.01;
  addPlane(scene, sph::Vec3::Zero(), sph::Vec3::UnitZ());
  scene.wounds.push_back(discWound(radius, flow));
  return scene;
}

sph::SetForce push(const sph::Vec3& at, double radius, const sph::Vec3& newtons) {
  sph::SetForce force;
  force.key = 1;
  force.position = at;
  force.radius = radius;
  force.force = newtons;
  return force;
}

double smallestDistance(Trial& trial) {
  const sph::FrameBuffer& frame = trial.frame();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < frame.count; ++i) {
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, (positionOf(frame, i) - positionOf(frame, j)).norm());
  }
  return smallest / trial.world().description().spacing;
}

double speedRms(const Trial& trial) {
  const sph::WorldStats stats = trial.stats();
  return stats.particles == 0 ? 0.0 : std::sqrt(2.0 * stats.kinetic_energy / (trial.world().particleMass() * stats.particles));
}

std::vector<sph::Vec3> positionsById(Trial& trial) {
  const sph::FrameBuffer& frame = trial.frame();
  std::vector<sph::Vec3> positions(frame.count);
  for (std::size_t i = 0; i < frame.count; ++i) {
    if (frame.id[i] <= positions.size()) positions[frame.id[i] - 1] = positionOf(frame, i);
  }
  return positions;
}

}  // namespace bleedsim::lab
