// Drops and other shapes that a box lattice does not have: every particle is a block of its own.
#pragma once

#include <functional>

#include "service/sph/world.h"

namespace bleedsim::test {

void addParticle(sph::WorldDescription& scene, const sph::Vec3& position, const sph::Vec3& velocity = sph::Vec3::Zero());

/// The points of the scene's lattice within `radius` (m) of `center` that `inside` takes; the lattice stands half a spacing off
/// the center. Velocities by position.
void addBall(
    sph::WorldDescription& scene, const sph::Vec3& center, double radius,
    const std::function<bool(const sph::Vec3&)>& inside = [](const sph::Vec3&) { return true; });

/// The particles of a world, at rest where they are, instead of the description's own; `velocity` by position.
sph::WorldDescription restarted(
    const sph::World& world,
    const std::function<sph::Vec3(const sph::Vec3&)>& velocity = [](const sph::Vec3&) -> sph::Vec3 { return sph::Vec3::Zero(); });

}  // namespace bleedsim::test
