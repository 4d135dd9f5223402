// Kick-drift-kick (velocity Verlet): v += a dt/2, x += v dt, new a, v += a dt/2. Time-reversible, so a closed box keeps its
// energy. With the whole kick before the drift and none after it this is symplectic Euler, as the literal model has it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/neighbors/domain_box.h"
#include "service/sph/particles.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {

/// What one share of the opening kick and drift found.
template <class Real>
struct alignas(64) DriftResult {
  Bounds<Real> bounds;
  std::uint32_t left_domain = 0;
};

/// Opening half kick and drift of the particles of a range. Particles of a throat go where their wound is now; those it releases
/// become free. Particles that leave the domain get CellGrid::kRemoved in `cells`, all others 0.
template <class Real>
DriftResult<Real> kickAndDrift(Particles<Real>& p, const Real* acceleration, Real half_dt, Real dt_per_h, double h,
                               const DomainBox<Real>& domain, const WoundSet& wounds, ShareRange range, std::uint32_t* cells) {
  DriftResult<Real> result;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    cells[i] = 0;
    if (p.driver[i] != 0) {
      const InletState state = wounds.kinematics(p.driver[i]);
      p.x[i] = static_cast<Real>(state.position.x() / h);
      p.y[i] = static_cast<Real>(state.position.y() / h);
      p.z[i] = static_cast<Real>(state.position.z() / h);
      p.vx[i] = static_cast<Real>(state.velocity.x());
      p.vy[i] = static_cast<Real>(state.velocity.y());
      p.vz[i] = static_cast<Real>(state.velocity.z());
      if (state.phase == InletPhase::released) p.driver[i] = 0;
    } else {
      const Real* a = acceleration + std::size_t{i} * 4;
      p.vx[i] += a[0] * half_dt;
      p.vy[i] += a[1] * half_dt;
      p.vz[i] += a[2] * half_dt;
      Real* const position[3] = {&p.x[i], &p.y[i], &p.z[i]};
      const Real velocity[3] = {p.vx[i], p.vy[i], p.vz[i]};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        Real& x = *position[k];
        x += velocity[k] * dt_per_h;
        if (domain.periodic[k]) {
          x = domain.wrapped(k, x);
        } else {
          inside = inside && x >= domain.lower[k] && x <= domain.upper[k];
        }
      }
      if (!inside) {
        cells[i] = CellGrid<Real>::kRemoved;
        ++result.left_domain;
        continue;
      }
    }
    result.bounds.include(p.x[i], p.y[i], p.z[i]);
  }
  return result;
}

/// Bound on accelerations, in c0^2/dx.
constexpr double kAccelerationBound = 6.25;

/// Bounds that keep a step sane whatever acts; each use is counted. v_cap = 2 c0; a_cap halves no dt below a quarter of the
/// acoustic one: 0.25 sqrt(dx/a_cap) = 0.1 dx/c0.
template <class Real>
struct MotionCaps {
  Real speed = 0;         ///< m/s
  Real acceleration = 0;  ///< m/s^2
};

/// What one share of the closing kick found.
template <class Real>
struct alignas(64) KickResult {
  Real max_speed2 = 0;         ///< (m/s)^2
  Real max_acceleration2 = 0;  ///< (m/s^2)^2
  std::uint64_t speed_clamped = 0;
  std::uint64_t acceleration_clamped = 0;
  bool finite = true;
};

/// Adds gravity to the accelerations, clamps them, and gives the closing half kick.
template <class Real>
KickResult<Real> closingKick(Particles<Real>& p, Real* acceleration, const std::array<Real, 3>& gravity, Real half_dt,
                             const MotionCaps<Real>& caps, ShareRange range) {
  KickResult<Real> result;
  const Real speed_cap2 = caps.speed * caps.speed;
  const Real acceleration_cap2 = caps.acceleration * caps.acceleration;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    Real* a = acceleration + std::size_t{i} * 4;
    if (p.driver[i] != 0) {
      a[0] = a[1] = a[2] = Real(0);
      result.max_speed2 = std::max(result.max_speed2, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) a[k] += gravity[k];
    Real a2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    if (a2 > acceleration_cap2) {
      const Real scale = caps.acceleration / std::sqrt(a2);
      for (std::size_t k = 0; k < 3; ++k) a[k] *= scale;
      a2 = acceleration_cap2;
      ++result.acceleration_clamped;
    }
    p.vx[i] += a[0] * half_dt;
    p.vy[i] += a[1] * half_dt;
    p.vz[i] += a[2] * half_dt;
    Real v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (v2 > speed_cap2) {
      const Real scale = caps.speed / std::sqrt(v2);
      p.vx[i] *= scale;
      p.vy[i] *= scale;
      p.vz[i] *= scale;
      v2 = speed_cap2;
      ++result.speed_clamped;
    }
    result.finite = result.finite && std::isfinite(v2) && std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
    result.max_speed2 = std::max(result.max_speed2, v2);
    result.max_acceleration2 = std::max(result.max_acceleration2, a2);
  }
  return result;
}

}  // namespace bleedsim::sph
