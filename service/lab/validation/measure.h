// What cases build their scenes from and read from their worlds. SI units.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "service/lab/frame_vectors.h"
#include "service/lab/scene_parts.h"
#include "service/lab/validation/knobs.h"

namespace bleedsim::lab {

inline constexpr double kGravity = 9.81;         ///< m/s^2
inline constexpr double kBloodDensity = 1060.0;  ///< kg/m^3

/// Blood without a particle, tissue or effect, at the knobs' support ratio, Mach factor and seed.
sph::WorldDescription emptyScene(const Knobs& knobs, double spacing, double design_speed);

/// Fewest particles along a periodic side whose flow does not vary: more than three support radii, at least 8.
int periodicCount(const Knobs& knobs);

/// Adds a block of `counts` particles.
void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts);

/// The scene with a domain of three periodic sides, filled with blood from a corner at the origin; or with a closed box.
void fillPeriodic(sph::WorldDescription& scene, const Counts& counts, double jitter);
void fillBox(sph::WorldDescription& scene, const Counts& counts, double jitter);

using VelocityField = std::function<sph::Vec3(const sph::Vec3&)>;

/// The scene's first block cut into columns along an axis, one spacing wide, each with the velocity of `field` at its middle.
void setFlow(sph::WorldDescription& scene, int along, const VelocityField& field);

/// A particle of its own block.
void addParticle(sph::WorldDescription& scene, const sph::Vec3& position, const sph::Vec3& velocity);
/// The points of the scene's lattice within `radius` of the origin that `inside` takes; it stands half a spacing off the origin.
void addBall(
    sph::WorldDescription& scene, double radius,
    const std::function<bool(const sph::Vec3&)>& inside = [](const sph::Vec3&) { return true; });

/// A copy of a world's particles.
struct Frame {
  sph::FrameBuffer buffer;

  std::size_t size() const { return buffer.count; }
  sph::Vec3 position(std::size_t i) const { return positionOf(buffer, i); }
  sph::Vec3 velocity(std::size_t i) const { return velocityOf(buffer, i); }
  double density(std::size_t i) const { return static_cast<double>(buffer.density[i]); }
  double platelet(std::size_t i) const { return static_cast<double>(buffer.platelet[i]); }
};
Frame frameOf(const sph::World& world);

/// The description of a world with its particles where they are now.
sph::WorldDescription restarted(
    const sph::World& world, const VelocityField& velocity = [](const sph::Vec3&) -> sph::Vec3 { return sph::Vec3::Zero(); });

/// The mean of `value` over the particles with floor(x[axis]/dx) == layer; NaN without one.
double layerMean(const Frame& frame, double spacing, int axis, int layer, const std::function<double(std::size_t)>& value);

/// Kinetic + elastic + contact springs + gravity, J. Elastic: e(rho) = c0^2 (ln(rho/r) + r/rho - 1) above the density r = rho0 -
/// p0/c0^2 at which the pressure ends, de/drho = p/rho^2; below it too in the literal model, whose pressure does not end (its
/// stiffness is taken to be c0^2). A spring holds m c0^2 ((dx/2 - d)/dx)^2/2 at d < dx/2 from a wall, one for each face of a
/// container.
double energyOf(const sph::World& world);

/// sqrt(sum (found - wanted)^2/sum wanted^2).
class RelativeL2 {
 public:
  void add(double found, double wanted) {
    squares_ += (found - wanted) * (found - wanted);
    reference_ += wanted * wanted;
  }
  double value() const;

 private:
  double squares_ = 0.0;
  double reference_ = 0.0;
};

}  // namespace bleedsim::lab
