// Core radius: every particle's own support radius follows its density.
//
// Equation (34) of the paper:
//   h_i <- lambda (m_i/rho_i)^(1/3)
// terms: h m; m kg; rho kg/m^3; lambda = h/dx on the rest lattice, where m/rho0 = dx^3, so that h_i/h -> (rho0/rho_i)^(1/3).
// Deviation from the paper: left alone, an isolated particle's h grows by a third in every step. h_i is bounded, and goes only a
// part of the way in each step. A pair sees (W(h_i) + W(h_j))/2, so that action equals reaction. The rest lattice's mass and
// viscosity are calibrated at the particle's own radius (LatticeFactors), so blood at rest is at rest at any radius.
// The sums leave out the change of h_i with rho_i: a radius that shrinks under pressure does work that nobody pays for. Following
// every ripple of the density, (34) pumps a periodic inviscid box to 49 times its energy by t = 200 dx/c0 (h = 2 dx; 18 times at
// 2.5 dx; 28 times with blood's 3.45 mPa s). So radii ignore a density within kQuiet of the rest density, which is disorder of
// nearly incompressible blood and no change of its density, and follow (34) in full from twice that on: surfaces, films, drops.
// The box then keeps its energy to 0.2 %.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "service/sph/effect_settings.h"
#include "service/sph/effects/move_radii.h"
#include "service/sph/executor.h"
#include "service/sph/particles.h"
#include "service/sph/radius_nodes.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {

/// What the kernel of a particle's own radius is multiplied by, and what its viscosity, relative to radius h: from
/// calibrateRestLattice at the radius' nodes. Measured at h = 2 dx: 0.970 and 1.120 at 0.9 h, 1.024 and 0.987 at 1.3 h; between
/// the nodes the straight line is off by at most 0.5 % in mass and 1.6 % in viscosity (2.5 dx: 0.1 % and 0.4 %).
template <class Real>
class LatticeFactors {
 public:
  LatticeFactors(const SmoothingKernel& kernel, double spacing, const RadiusBounds& bounds);

  Real mass(Real radius) const { return between(mass_, radius); }
  Real viscosity(Real radius) const { return between(viscosity_, radius); }

 private:
  Real between(const std::array<Real, kRadiusNodes>& values, Real radius) const {
    const RadiusPlace<Real> place = scale_.at(radius);
    return values[place.node] + place.part * (values[place.node + 1] - values[place.node]);
  }

  RadiusScale<Real> scale_;
  std::array<Real, kRadiusNodes> mass_{};
  std::array<Real, kRadiusNodes> viscosity_{};
};

template <class Real>
class CoreRadius {
 public:
  CoreRadius(const CoreRadiusSettings& settings, double rest_density, int shares);

  /// Part of the rest density by which blood must be off it before radii follow; from 2 kQuiet on they follow (34) itself.
  static constexpr double kQuiet = 0.15;

  /// Moves the radii of the free particles towards (34); those of a throat stay at h. `density` in kg/m^3. Returns the largest
  /// radius over h, at least 1, as new particles have: how far the next step must search.
  Real update(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor);

 private:
  /// The deviation rho/rho0 - 1 as radii see it.
  static Real followed(Real deviation) {
    const Real size = std::abs(deviation);
    return std::copysign(std::min(size, std::max(Real(0), Real(2) * (size - static_cast<Real>(kQuiet)))), deviation);
  }

  Real smallest_, largest_, relaxation_;
  Real least_ratio_, most_ratio_;  // of volumes: the bounds' cubes
  Real rest_density_;
  RadiusMover<Real> mover_;
};

extern template class LatticeFactors<float>;
extern template class LatticeFactors<double>;
extern template class CoreRadius<float>;
extern template class CoreRadius<double>;

}  // namespace bleedsim::sph
