#include "service/lab/hardcases/case_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bleedsim::lab {
namespace {

sph::Vec3 extentOf(const sph::WorldDescription& scene, const Counts& counts) {
  return scene.spacing * sph::Vec3{double(counts[0]), double(counts[1]), double(counts[2])};
}

}  // namespace

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
  sph::FluidBlock block;
  block.lower = lower;
  block.upper = lower + extentOf(scene, counts);
  block.velocity = velocity;
  scene.fluid_blocks.push_back(block);
}

void addLoneParticle(sph::WorldDescription& scene, const sph::Vec3& at, const sph::Vec3& velocity) {
  addBlock(scene, at - sph::Vec3::Constant(0.5 * scene.spacing), {1, 1, 1}, velocity);
}

void addBox(sph::WorldDescription& scene, const Counts& counts, bool open_top) {
  sph::BoxShape box;
  box.upper = extentOf(scene, counts);
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

sph::WoundDescription discWound(double radius, double flow) {
  sph::WoundDescription wound;
  wound.shape = sph::DiscPatch{radius};
  wound.drive = sph::FlowDrive{flow};
  return wound;
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

sph::Vec3 positionOf(const sph::FrameBuffer& frame, std::size_t particle) {
  const float* p = frame.position.data() + 3 * particle;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

sph::Vec3 velocityOf(const sph::FrameBuffer& frame, std::size_t particle) {
  const float* v = frame.velocity.data() + 3 * particle;
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
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

double momentumScale(Trial& trial) {
  const sph::FrameBuffer& frame = trial.frame();
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) sum += velocityOf(frame, i).norm();
  return trial.world().particleMass() * sum;
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
