// How many pairs the solver looks at, counted apart from it on the particles as they stand.
#pragma once

#include <cstdint>

#include "service/sph/world.h"

namespace bleedsim::lab {

/// Means over the particles, in each step.
struct Census {
  std::uint32_t particles = 0;
  double neighbors = 0.0;  ///< other particles within a particle's own support radius
  double listed = 0.0;  ///< particles within the larger radius of the two (the literal model: its own), itself included: what the
                        ///< pair loops have to walk
  double candidates = 0.0;  ///< tested by their distance: those of the 27 cells that are near the box of the cell's particles
  double boxed = 0.0;       ///< of the 27 cells, tested against that box once for all particles of a cell, and shared among them
  double surface = 0.0;     ///< share of the particles whose curvature tension acts; 0 without tension, tissue not counted
};

/// Allocates room for a frame of the world's capacity. Unseen particles in wounds' throats are not counted.
Census takeCensus(const sph::World& world);

}  // namespace bleedsim::lab
