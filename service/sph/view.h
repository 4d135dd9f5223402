// Read-only views of the particle state: frames, statistics, hash.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "service/sph/particles.h"
#include "service/sph/world.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {

/// Copies the particles that are not behind a patch. `viscosity` is that of particles that carry none.
template <class Real>
void copyVisible(const Particles<Real>& p, const Real* density, std::uint32_t count, double h, const WoundSet& wounds,
                 double viscosity, std::uint32_t attributes, FrameBuffer& frame) {
  const Real scale = static_cast<Real>(h);
  std::uint32_t n = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (p.driver[i] != 0 && wounds.kinematics(p.driver[i]).phase == InletPhase::throat) continue;
    frame.position[3 * std::size_t{n}] = static_cast<float>(p.x[i] * scale);
    frame.position[3 * std::size_t{n} + 1] = static_cast<float>(p.y[i] * scale);
    frame.position[3 * std::size_t{n} + 2] = static_cast<float>(p.z[i] * scale);
    frame.id[n] = p.id[i];
    if (attributes & kFrameVelocity) {
      frame.velocity[3 * std::size_t{n}] = static_cast<float>(p.vx[i]);
      frame.velocity[3 * std::size_t{n} + 1] = static_cast<float>(p.vy[i]);
      frame.velocity[3 * std::size_t{n} + 2] = static_cast<float>(p.vz[i]);
    }
    if (attributes & kFrameDensity) frame.density[n] = static_cast<float>(density[i]);
    if (attributes & kFrameViscosity) {
      frame.viscosity[n] =
          static_cast<float>(p.inverse_viscosity.empty() ? viscosity : 1.0 / static_cast<double>(p.inverse_viscosity[i]));
    }
    if (attributes & kFramePlatelet) frame.platelet[n] = p.platelet.empty() ? 0.0F : static_cast<float>(p.platelet[i]);
    if (attributes & kFrameRadius) frame.radius[n] = static_cast<float>(p.radius.empty() ? scale : p.radius[i] * scale);
    ++n;
  }
  frame.count = n;
  frame.attributes = attributes;
}

/// Density errors, energy, momentum and centre of the free particles; one fixed order, so equal for any thread count.
template <class Real>
void addParticleStats(const Particles<Real>& p, const Real* density, std::uint32_t count, double h, double rest_density,
                      double mass, WorldStats& stats) {
  double error_sum = 0.0;
  double error_max = 0.0;
  double speed2_sum = 0.0;
  Vec3 velocity_sum = Vec3::Zero();
  Vec3 position_sum = Vec3::Zero();
  std::uint32_t free = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (p.driver[i] != 0) continue;
    const double error = std::max(0.0, static_cast<double>(density[i]) / rest_density - 1.0);
    error_sum += error;
    error_max = std::max(error_max, error);
    const Vec3 velocity{static_cast<double>(p.vx[i]), static_cast<double>(p.vy[i]), static_cast<double>(p.vz[i])};
    velocity_sum += velocity;
    position_sum += Vec3{static_cast<double>(p.x[i]), static_cast<double>(p.y[i]), static_cast<double>(p.z[i])};
    speed2_sum += velocity.squaredNorm();
    ++free;
  }
  stats.mean_density_error = free > 0 ? error_sum / free : 0.0;
  stats.max_density_error = error_max;
  stats.kinetic_energy = 0.5 * mass * speed2_sum;
  stats.momentum = mass * velocity_sum;
  stats.center = free > 0 ? Vec3{position_sum * (h / free)} : Vec3::Zero();
}

/// A 64-bit hash in four independent lanes of multiply and rotate, so that hashing every frame costs no frame. A word is
/// multiplied before it meets its lane and the lane after: with one multiplication, flips of two words' top bits cancel.
class StateHash {
 public:
  void addBytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (; size >= 32; size -= 32, bytes += 32) {
      std::uint64_t words[4];
      std::memcpy(words, bytes, 32);
      for (int k = 0; k < 4; ++k) lanes_[k] = mix(lanes_[k], words[k]);
    }
    std::uint64_t rest[4] = {};
    if (size > 0) std::memcpy(rest, bytes, size);
    for (int k = 0; k < 4; ++k) lanes_[k] = mix(lanes_[k], rest[k]);
  }
  std::uint64_t value() const {
    std::uint64_t h = 0;
    for (const std::uint64_t lane : lanes_) h = mix(h, lane ^ (lane >> 32));
    return h ^ (h >> 29);
  }

 private:
  static std::uint64_t mix(std::uint64_t h, std::uint64_t word) {
    return std::rotl(h ^ (word * 0xd6e8feb86659fd93ull), 29) * 0x9e3779b97f4a7c15ull;
  }
  std::uint64_t lanes_[4] = {0x243f6a8885a308d3ull, 0x13198a2e03707344ull, 0xa4093822299f31d0ull, 0x082efa98ec4e6c89ull};
};

template <class Real>
std::uint64_t hashState(const Particles<Real>& p, std::uint32_t count, double time) {
  StateHash hash;
  hash.addBytes(&time, sizeof time);
  for (const AlignedArray<Real>* array : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz})
    hash.addBytes(array->data(), count * sizeof(Real));
  for (const AlignedArray<Real>* array : {&p.inverse_viscosity, &p.own_viscosity, &p.platelet, &p.radius})
    if (!array->empty()) hash.addBytes(array->data(), count * sizeof(Real));
  hash.addBytes(p.id.data(), count * sizeof(std::uint32_t));
  hash.addBytes(p.driver.data(), count * sizeof(std::uint32_t));
  return hash.value();
}

}  // namespace bleedsim::sph
