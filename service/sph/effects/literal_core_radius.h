// Core radius as printed: after every step each particle's support radius is what its density says.
//
// Equation (34) of the paper:
//   h_i <- lambda (m/rho_i)^(1/d)
// terms: h_i m; m kg; rho kg/m^3; d dimension, 3 or, in a planar world, 2 with the density of a layer dx thick; lambda = h/dx,
// the scene's support ratio, so that blood at rest keeps 0.997 h (m is 0.99 rho0 dx^3 by poly6).
//
// Deviation from the paper: bounds, without which a lone particle's radius grows by lambda/1.161 in every step, for ever.
//   above   kLiteralLargestSpacings dx: the 27 cells around one then hold 1424 particles of blood at rest; the density pass takes
//           1832, beyond which every particle is on its slow path
//   below   kLiteralSmallestRadius h, which is eight times the density at rest: particles on one spot would shrink to nothing
//
// Known of it: radii differ inside a pair, so action is not reaction; and h_i follows every ripple of the density. Both add to
// the energy that the printed kernels pump: a closed box's grows 43 times instead of 25
// (tests/stability/sph/literal_energy_test.cpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "service/sph/cube_root.h"
#include "service/sph/effects/move_radii.h"
#include "service/sph/radius_nodes.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/world_description.h"

namespace bleedsim::sph {

constexpr double kLiteralSmallestRadius = 0.5;    ///< over h
constexpr double kLiteralLargestSpacings = 3.75;  ///< over dx

/// Of the radii over h, whatever the scene's CoreRadiusSettings, which are the sound model's.
constexpr RadiusBounds literalRadiusBounds(double support_ratio) {
  return {kLiteralSmallestRadius, std::max(1.0, kLiteralLargestSpacings / support_ratio)};
}

template <class Real>
class LiteralCoreRadius {
 public:
  LiteralCoreRadius(const WorldDescription& description, const RestLattice& lattice, int shares)
      : planar_{description.planar},
        smallest_{static_cast<Real>(literalRadiusBounds(description.support_ratio).smallest)},
        largest_{static_cast<Real>(literalRadiusBounds(description.support_ratio).largest)},
        least_room_{planar_ ? smallest_ * smallest_ : smallest_ * smallest_ * smallest_},
        most_room_{planar_ ? largest_ * largest_ : largest_ * largest_ * largest_},
        mass_per_volume_{static_cast<Real>(lattice.particle_mass / description.particleVolume())},
        mover_{shares} {}

  /// Gives the free particles the radii of (34). `density` in kg/m^3. Returns the largest radius over h, at least 1.
  Real update(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor) {
    const auto law = [planar = planar_, smallest = smallest_, largest = largest_, least = least_room_, most = most_room_,
                      mass = mass_per_volume_](Real rho, Real) {
      const Real room = std::clamp(mass / rho, least, most);  // m/rho_i over dx^d
      return std::clamp(planar ? std::sqrt(room) : cubeRoot(room), smallest, largest);
    };
    return mover_.move(p, density, count, shares, executor, law);
  }

 private:
  bool planar_;
  Real smallest_, largest_;
  Real least_room_, most_room_;  // of the bounds
  Real mass_per_volume_;         // m/dx^3, kg/m^3
  RadiusMover<Real> mover_;
};

}  // namespace bleedsim::sph
