// What descriptions of small worlds are made of. Of headers alone, so that tests of the solver use it without linking the lab.
#pragma once

#include <array>
#include <cmath>

#include "service/sph/world_description.h"

namespace bleedsim::lab {

/// Particles along x, y and z.
using Counts = std::array<int, 3>;

inline sph::Vec3 extentOf(double spacing, const Counts& counts) {
  return spacing * sph::Vec3{double(counts[0]), double(counts[1]), double(counts[2])};
}

inline sph::FluidBlock blockOf(double spacing, const sph::Vec3& lower, const Counts& counts) {
  sph::FluidBlock block;
  block.lower = lower;
  block.upper = lower + extentOf(spacing, counts);
  return block;
}

/// A block of one particle.
inline sph::FluidBlock particleAt(double spacing, const sph::Vec3& position, const sph::Vec3& velocity) {
  sph::FluidBlock block = blockOf(spacing, position - sph::Vec3::Constant(0.5 * spacing), {1, 1, 1});
  block.velocity = velocity;
  return block;
}

/// Calls add(x) for the points of the lattice within `radius` of `center`; it stands half a spacing off the center. Lengths in m.
template <class Add>
void forEachInBall(double spacing, const sph::Vec3& center, double radius, const Add& add) {
  const int reach = static_cast<int>(std::ceil(radius / spacing));
  for (int z = -reach; z < reach; ++z) {
    for (int y = -reach; y < reach; ++y) {
      for (int x = -reach; x < reach; ++x) {
        const sph::Vec3 offset = spacing * sph::Vec3{x + 0.5, y + 0.5, z + 0.5};
        if (offset.norm() <= radius) add(sph::Vec3{center + offset});
      }
    }
  }
}

/// A disc wound at the origin that faces +z; m and m^3/s.
inline sph::WoundDescription discWound(double radius, double flow) {
  sph::WoundDescription wound;
  wound.shape = sph::DiscPatch{radius};
  wound.drive = sph::FlowDrive{flow};
  return wound;
}

}  // namespace bleedsim::lab
