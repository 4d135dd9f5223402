// What the literal model's force pass is given.
#pragma once

#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

template <class Real>
struct LiteralJob : SweepJob<Real> {
  /// K p/rho = slope + constant/rho: K k and K (p_0 - k rho0). K = m x norm of (31)/h^4, for (17) half of it; p_0 the background
  /// pressure.
  Real pressure_slope = 0;
  Real pressure_constant = 0;
  Real viscosity_scale = 0;  ///< K, or K mu where the records hold no viscosity; K = m x norm of (33)/h^5
  Real platelet_scale = 0;   ///< K k, m^3/(kg s)
  Real tension_scale = 0;    ///< eps m x norm of (31)/h^5
  Real tension_cutoff2 = 0;  ///< squared cut-off of |n| h, over (m x norm of (31)/h^3)^2
  Real turns = 2;            ///< d - 1
  Real repulsion_scale = 0;  ///< D/(m h^2), m/s^2
  Real contact = 0;          ///< r_i + r_j, /h
  int repulsion_powers[2] = {6, 4};
  Real* acceleration = nullptr;  ///< 4 per particle: x, y, z in m/s^2; the platelets' rate, 1/s
};

template <class Real>
using LiteralFunction = void (*)(const LiteralJob<Real>&);

}  // namespace bleedsim::sph
