// What the stability and validation cases measure of a world, and what they require of every world.
#pragma once

#include <cstdint>
#include <functional>

#include "tests/support/scenes.h"

namespace bleedsim::test {

/// Adds a block of `counts` particles; its viscosity is the scene's.
void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts,
              const sph::Vec3& velocity = sph::Vec3::Zero());

/// Steps until `seconds` of simulated time have passed, to within one step; a refused step fails the test. `each` runs after
/// every step.
void runFor(
    sph::World& world, double seconds, const std::function<void()>& each = [] {});

/// Kinetic + elastic + contact springs + gravity, J. Elastic: e(rho) = c0^2 (ln(rho/r) + r/rho - 1) above the density r = rho0 -
/// p0/c0^2 at which the pressure ends, de/drho = p/rho^2; below it too in the literal model, whose pressure does not end (its
/// stiffness is taken to be c0^2). A spring holds m c0^2 ((dx/2 - d)/dx)^2 / 2 at d < dx/2 from a wall,
/// one for each face of a container.
double energyOf(const sph::World& world);

/// Root mean square speed, m/s.
double speedRms(const sph::World& world);

/// Smallest signed distance of a particle to the tissue, in spacings; infinity without either.
double lowestPhi(const sph::World& world);

/// physics.md section 6, "always": everything finite, nothing deeper than 0.1 dx in the tissue, count = injected - removed,
/// |v| <= 2 c0.
void expectInvariants(const sph::World& world);

/// The mean of `value` over the particles of a frame whose height above `floor` lies in the layer: floor((z - floor)/dx) ==
/// layer.
double layerMean(const sph::World& world, const sph::FrameBuffer& frame, int axis, double floor, int layer,
                 const std::function<double(std::size_t)>& value);

/// `block` cut into columns of one spacing along x and y or z, each with the velocity that `field` has at its middle.
std::vector<sph::FluidBlock> blocksWithFlow(const sph::FluidBlock& block, double spacing, int along,
                                            const std::function<sph::Vec3(const sph::Vec3&)>& field);

}  // namespace bleedsim::test
