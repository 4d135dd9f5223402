// The oracle of the literal model: the paper's sums over every pair in double precision, from the closed forms of its kernels.
#pragma once

#include "service/sph/world_description.h"
#include "tests/support/brute_force.h"

namespace bleedsim::test {

/// Density (20) with poly6, pressure (16)/(17)(19), tension (21)-(23), viscosity (25), platelets (26)(27) and repulsion (35)(36)
/// with Table I's else-branch, without tissue. With core radius (34) every particle's sums are over kernels of its own
/// `particles.radius`, contacts out to h at least. `particles.viscosity` is read where the scene has no platelets, if it is not
/// empty. Sees the nearest image across periodic sides. O(n^2).
OracleFields literalOracle(const sph::WorldDescription& description, const OracleParticles& particles);

}  // namespace bleedsim::test
