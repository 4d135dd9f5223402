// What a step does by its formulas: floating-point operations and bytes of each stage, per particle.
//
// The count is fixed: it goes by the equations and by the arrays' fields, not by the compiled code, so that shares of the
// roofline can be compared between versions of the solver. Who computes less than is counted here rises above what the code
// itself does.
//
// flops  An add, multiply, divide, square root, minimum, maximum or compare is one; a fused multiply-add two. Pair terms are
//        multiplied by the length of the lists, the search by its tests (census.h); padding is not counted. What is done once for
//        each particle is counted where it is arithmetic of motion and density, and left out where it is small beside the pairs
//        (rheology, radii, tension's normals). The sound model's platelets are left out, whose diffusion, shear gate and clotting
//        need not act in every step.
// bytes  Each array that a stage reads or writes moves once: four bytes a number, 16 a list of accelerations, the records by the
//        groups that the effects need, lists by their entries. A cache that holds everything between two stages would move less,
//        one that holds nothing more.
// The stages emit, tissue and body are not counted: their work depends on who is near a wound or a wall.
#pragma once

#include <array>

#include "service/lab/bench/census.h"
#include "service/sph/world.h"

namespace bleedsim::lab {

/// Per particle and step.
struct Work {
  double flops = 0.0;
  double bytes = 0.0;

  Work& operator+=(const Work& other) {
    flops += other.flops;
    bytes += other.bytes;
    return *this;
  }
};

using StageWork = std::array<Work, static_cast<std::size_t>(sph::Stage::count)>;

/// flops for each entry of a list in the force stage's first, fused sweep.
double pairFlops(const sph::WorldDescription& scene, bool implicit_viscosity);

/// `solver_iterations` of the implicit viscosity in a step; 0: it is explicit.
StageWork workOf(const sph::WorldDescription& scene, const Census& census, int solver_iterations);

Work totalOf(const StageWork& stages);

}  // namespace bleedsim::lab
