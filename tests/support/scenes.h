// Small worlds for the tests of the solver. Spacing 1 mm, h = 2 dx, blood of 1060 kg/m^3, unless a test changes the description.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "service/sph/world.h"

namespace bleedsim::test {

inline constexpr double kSpacing = 0.001;       ///< m
inline constexpr double kRestDensity = 1060.0;  ///< kg/m^3
inline constexpr double kGravity = 9.81;        ///< m/s^2

/// Particles along x, y and z.
using Counts = std::array<int, 3>;

/// No particle, no tissue, no effect. Domain +-50 mm, room for 20 000 particles, c0 = 5 m/s.
sph::WorldDescription emptyScene();

/// A block about the origin in empty space with pressure and viscosity; no gravity. `jitter` in spacings.
sph::WorldDescription freeBlock(const Counts& counts, double jitter = 0.0);

/// Blood that fills a closed box of tissue with a corner at the origin; pressure and viscosity, no gravity.
sph::WorldDescription closedBox(const Counts& counts, double jitter = 0.0);

/// Blood that fills a domain with three periodic sides and a corner at the origin; pressure and viscosity, no gravity. Each
/// count at least 6.
sph::WorldDescription periodicBox(const Counts& counts, double jitter = 0.0);

/// Blood at rest in a box of tissue without its top, a corner at the origin, under gravity; `viscosity` in Pa s.
sph::WorldDescription hydrostaticColumn(const Counts& counts, double viscosity);

/// A disc wound at the origin of the tissue plane z = 0, under gravity; `radius` in m, `flow` in m^3/s.
sph::WorldDescription woundOnPlane(double radius, double flow);

/// A disc wound at the origin that faces +z.
sph::WoundDescription discWound(double radius, double flow);

/// The world of a description that must be valid; throws std::runtime_error with the refusal otherwise.
std::unique_ptr<sph::World> makeWorld(const sph::WorldDescription& description, const sph::WorldOptions& options = {});

sph::WorldStats statsOf(const sph::World& world);
std::uint64_t counterOf(const sph::World& world, sph::Counter counter);

/// A frame with every attribute, its buffers cut to the particles that it holds.
sph::FrameBuffer frameOf(const sph::World& world);

sph::Vec3 positionOf(const sph::FrameBuffer& frame, std::size_t particle);  ///< m
sph::Vec3 velocityOf(const sph::FrameBuffer& frame, std::size_t particle);  ///< m/s
/// Sum of m v of a frame's particles, kg m/s.
sph::Vec3 momentumOf(const sph::World& world);
/// Sum of m |v|, kg m/s: what a momentum's error is measured by.
double momentumScaleOf(const sph::World& world);

}  // namespace bleedsim::test
