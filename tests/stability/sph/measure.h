// What the stability and validation cases measure of a world, and what they require of every world.
#pragma once

#include <cstdint>
#include <functional>

#include "service/lab/validation/measure.h"
#include "tests/support/scenes.h"

namespace bleedsim::test {

using lab::energyOf;
using lab::setFlow;

/// Adds a block of `counts` particles; its viscosity is the scene's.
void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts,
              const sph::Vec3& velocity = sph::Vec3::Zero());

/// Steps until `seconds` of simulated time have passed, to within one step; a refused step fails the test. `each` runs after
/// every step.
void runFor(
    sph::World& world, double seconds, const std::function<void()>& each = [] {});

/// Root mean square speed, m/s.
double speedRms(const sph::World& world);

/// Smallest signed distance of a particle to the tissue, in spacings; infinity without either.
double lowestPhi(const sph::World& world);

/// physics.md section 6, "always": everything finite, nothing deeper than 0.1 dx in the tissue, count = injected - removed,
/// |v| <= 2 c0.
void expectInvariants(const sph::World& world);

}  // namespace bleedsim::test
