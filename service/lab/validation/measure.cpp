#include "service/lab/validation/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::lab {
namespace {

using sph::Vec3;

constexpr std::uint32_t kAttributes = sph::kFrameVelocity | sph::kFrameDensity | sph::kFramePlatelet;

void addJittered(sph::WorldDescription& scene, const Counts& counts, double jitter) {
  addBlock(scene, Vec3::Zero(), counts);
  scene.fluid_blocks.back().jitter = jitter;
}

/// The walls that push by themselves: a container has one spring for each face.
std::vector<sph::TissueShape> springsOf(const sph::WorldDescription& scene) {
  std::vector<sph::TissueShape> springs;
  for (const sph::TissueDescription& tissue : scene.tissue) {
    const auto* box = std::get_if<sph::BoxShape>(&tissue.shape);
    if (box == nullptr || box->obstacle) {
      springs.push_back(tissue.shape);
      continue;
    }
    for (const sph::PlaneShape& face : sph::containerFaces(*box)) springs.emplace_back(face);
  }
  return springs;
}

}  // namespace

sph::WorldDescription emptyScene(const Knobs& knobs, double spacing, double design_speed) {
  sph::WorldDescription scene;
  scene.seed = knobs.seed;
  scene.spacing = spacing;
  scene.support_ratio = knobs.support_ratio;
  scene.rest_density = kBloodDensity;
  scene.compressibility.mach_factor = knobs.mach_factor;
  scene.compressibility.design_speed = design_speed;
  return scene;
}

int periodicCount(const Knobs& knobs) { return std::max(8, static_cast<int>(std::ceil(3.0 * knobs.support_ratio + 1e-6))); }

void addBlock(sph::WorldDescription& scene, const Vec3& lower, const Counts& counts) {
  scene.fluid_blocks.push_back(blockOf(scene.spacing, lower, counts));
  scene.capacity += static_cast<std::uint32_t>(counts[0] * counts[1] * counts[2]);
}

void fillPeriodic(sph::WorldDescription& scene, const Counts& counts, double jitter) {
  scene.domain.lower = Vec3::Zero();
  scene.domain.upper = extentOf(scene.spacing, counts);
  scene.domain.periodic = {true, true, true};
  addJittered(scene, counts, jitter);
}

void fillBox(sph::WorldDescription& scene, const Counts& counts, double jitter) {
  sph::BoxShape box;
  box.upper = extentOf(scene.spacing, counts);
  scene.tissue.push_back({.name = "box", .shape = box});
  scene.domain.lower = Vec3::Constant(-8.0 * scene.spacing);
  scene.domain.upper = box.upper + Vec3::Constant(8.0 * scene.spacing);
  addJittered(scene, counts, jitter);
}

void setFlow(sph::WorldDescription& scene, int along, const VelocityField& field) {
  const sph::FluidBlock block = scene.fluid_blocks.front();
  const int first = (along + 1) % 3;
  const int second = (along + 2) % 3;
  const auto count = [&](int axis) {
    return static_cast<int>(std::lround((block.upper[axis] - block.lower[axis]) / scene.spacing));
  };
  scene.fluid_blocks.clear();
  for (int j = 0; j < count(second); ++j) {
    for (int i = 0; i < count(first); ++i) {
      sph::FluidBlock column = block;
      column.lower[first] += i * scene.spacing;
      column.upper[first] = column.lower[first] + scene.spacing;
      column.lower[second] += j * scene.spacing;
      column.upper[second] = column.lower[second] + scene.spacing;
      column.velocity = field(0.5 * (column.lower + column.upper));
      scene.fluid_blocks.push_back(column);
    }
  }
}

void addParticle(sph::WorldDescription& scene, const Vec3& position, const Vec3& velocity) {
  scene.fluid_blocks.push_back(particleAt(scene.spacing, position, velocity));
  ++scene.capacity;
}

void addBall(sph::WorldDescription& scene, double radius, const std::function<bool(const Vec3&)>& inside) {
  forEachInBall(scene.spacing, Vec3::Zero(), radius, [&](const Vec3& at) {
    if (inside(at)) addParticle(scene, at, Vec3::Zero());
  });
}

Frame frameOf(const sph::World& world) {
  Frame frame;
  frame.buffer.reserve(world.description().capacity, kAttributes);
  world.copyFrame(frame.buffer, kAttributes);
  return frame;
}

sph::WorldDescription restarted(const sph::World& world, const VelocityField& velocity) {
  sph::WorldDescription scene = world.description();
  scene.fluid_blocks.clear();
  scene.capacity = 0;
  const Frame frame = frameOf(world);
  for (std::size_t i = 0; i < frame.size(); ++i) addParticle(scene, frame.position(i), velocity(frame.position(i)));
  return scene;
}

double layerMean(const Frame& frame, double spacing, int axis, int layer, const std::function<double(std::size_t)>& value) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (static_cast<int>(std::floor(frame.position(i)[axis] / spacing)) != layer) continue;
    sum += value(i);
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double energyOf(const sph::World& world) {
  const sph::WorldDescription& scene = world.description();
  const Frame frame = frameOf(world);
  const std::vector<sph::TissueShape> springs = springsOf(scene);
  const double c2 = world.speedOfSound() * world.speedOfSound();
  const double background = scene.effects.pressure ? scene.effects.pressure->background_pressure : 0.0;
  const bool literal = scene.model == sph::Model::literal;
  const double free_density = scene.rest_density - background / c2;
  const Vec3 gravity = scene.effects.gravity ? scene.effects.gravity->acceleration : Vec3::Zero();
  double sum = 0.0;  // over the mass of a particle
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3 at = frame.position(i);
    sum += 0.5 * frame.velocity(i).squaredNorm() - gravity.dot(at);
    const double ratio = frame.density(i) / free_density;
    if (scene.effects.pressure && (ratio > 1.0 || literal)) sum += c2 * (std::log(ratio) + 1.0 / ratio - 1.0);
    for (const sph::TissueShape& wall : springs) {
      const double depth = std::max(0.0, 0.5 - sph::signedDistance(wall, at).value / scene.spacing);
      sum += 0.5 * c2 * depth * depth;
    }
  }
  return world.particleMass() * sum;
}

double RelativeL2::value() const { return std::sqrt(squares_ / reference_); }

}  // namespace bleedsim::lab
