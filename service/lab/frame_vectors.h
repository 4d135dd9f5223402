// What a copied frame holds, as vectors. Of headers alone, so that tests of the solver use it without linking the lab.
#pragma once

#include <cstddef>

#include "service/sph/world.h"

namespace bleedsim::lab {

inline sph::Vec3 vectorAt(const float* values, std::size_t i) {
  const float* v = values + 3 * i;
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
inline sph::Vec3 positionOf(const sph::FrameBuffer& frame, std::size_t i) { return vectorAt(frame.position.data(), i); }  ///< m
inline sph::Vec3 velocityOf(const sph::FrameBuffer& frame, std::size_t i) { return vectorAt(frame.velocity.data(), i); }  ///< m/s

/// Sum of m |v|, kg m/s: what an error of momentum is measured by.
inline double momentumScale(const sph::World& world, const sph::FrameBuffer& frame) {
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.count; ++i) sum += velocityOf(frame, i).norm();
  return world.particleMass() * sum;
}

inline sph::WorldStats statsOf(const sph::World& world) {
  sph::WorldStats stats;
  world.collectStats(stats);
  return stats;
}

}  // namespace bleedsim::lab
