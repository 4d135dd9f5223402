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

/// Velocity after the opening kick of a free particle; the same bits wherever it is asked for.
template <class Real>
std::array<Real, 3> kickedVelocity(const Particles<Real>& p, const Real* acceleration, std::uint32_t i, Real half_dt) {
  const Real* a = acceleration + std::size_t{i} * 4;
  return {p.vx[i] + a[0] * half_dt, p.vy[i] + a[1] * half_dt, p.vz[i] + a[2] * half_dt};
}

/// Drift, with the velocities of the opening half kick, of the particles of a range. Their places go into `moved`, 4 entries a
/// particle and the last unused, so that the state before the step outlives it. Particles of a throat go where their wound is
/// now. Particles that leave the domain get CellGrid::kRemoved in `cells`, all others 0.
template <class Real>
DriftResult<Real> drift(const Particles<Real>& p, Real* moved, const Real* acceleration, Real half_dt, Real dt_per_h, double h,
                        const DomainBox<Real>& domain, const WoundSet& wounds, ShareRange range, std::uint32_t* cells) {
  DriftResult<Real> result;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    cells[i] = 0;
    Real* position = moved + std::size_t{i} * 4;
    if (p.driver[i] != 0) {
      const Vec3 driven = wounds.kinematics(p.driver[i]).position;
      for (int k = 0; k < 3; ++k) position[k] = static_cast<Real>(driven[k] / h);
    } else {
      const std::array<Real, 3> velocity = kickedVelocity(p, acceleration, i, half_dt);
      position[0] = p.x[i];
      position[1] = p.y[i];
      position[2] = p.z[i];
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        Real& x = position[k];
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
    result.bounds.include(position[0], position[1], position[2]);
  }
  return result;
}

/// The opening half kick of particle i, if any, into place `to` of another order; a throat gives its particles their velocities,
/// and frees those that it releases.
template <class Real>
void kick(Particles<Real>& sorted, std::uint32_t to, const Particles<Real>& p, std::uint32_t i, const Real* acceleration,
          Real half_dt, const WoundSet& wounds) {
  if (p.driver[i] != 0) {
    const InletState state = wounds.kinematics(p.driver[i]);
    sorted.vx[to] = static_cast<Real>(state.velocity.x());
    sorted.vy[to] = static_cast<Real>(state.velocity.y());
    sorted.vz[to] = static_cast<Real>(state.velocity.z());
    if (state.phase == InletPhase::released) sorted.driver[to] = 0;
    return;
  }
  const std::array<Real, 3> velocity =
      half_dt != Real(0) ? kickedVelocity(p, acceleration, i, half_dt) : std::array<Real, 3>{p.vx[i], p.vy[i], p.vz[i]};
  sorted.vx[to] = velocity[0];
  sorted.vy[to] = velocity[1];
  sorted.vz[to] = velocity[2];
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
  std::uint32_t free = 0;    ///< particles that no wound drives; counted by guardedKick only (recovery.h)
  std::uint32_t capped = 0;  ///< of them, with an infinite force that guardedKick made finite
  std::uint32_t frozen = 0;  ///< of them, stopped by guardedKick

  void merge(const KickResult& other) {
    max_speed2 = std::max(max_speed2, other.max_speed2);
    max_acceleration2 = std::max(max_acceleration2, other.max_acceleration2);
    speed_clamped += other.speed_clamped;
    acceleration_clamped += other.acceleration_clamped;
    finite = finite && other.finite;
    free += other.free;
    capped += other.capped;
    frozen += other.frozen;
  }
};

/// Scales a vector, whose squared length is `square` > bound^2, to the bound; its square may have overflowed.
template <class Real>
void scaleTo(Real bound, Real square, Real& x, Real& y, Real& z) {
  if (std::isinf(square)) {
    const Real most = std::max({std::abs(x), std::abs(y), std::abs(z)});
    x /= most;
    y /= most;
    z /= most;
    square = x * x + y * y + z * z;
  }
  const Real scale = bound / std::sqrt(square);
  x *= scale;
  y *= scale;
  z *= scale;
}

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
      scaleTo(caps.acceleration, a2, a[0], a[1], a[2]);
      a2 = acceleration_cap2;
      ++result.acceleration_clamped;
    }
    p.vx[i] += a[0] * half_dt;
    p.vy[i] += a[1] * half_dt;
    p.vz[i] += a[2] * half_dt;
    Real v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (v2 > speed_cap2) {
      scaleTo(caps.speed, v2, p.vx[i], p.vy[i], p.vz[i]);
      v2 = speed_cap2;
      ++result.speed_clamped;
    }
    // An acceleration that is no number, or infinite, has made v2 one that is not; a[3] is the platelets' rate.
    result.finite = result.finite && std::isfinite(v2 + a[3]);
    result.max_speed2 = std::max(result.max_speed2, v2);
    result.max_acceleration2 = std::max(result.max_acceleration2, a2);
  }
  return result;
}

/// Clamps the speeds of free particles that something after the kick has raised.
template <class Real>
KickResult<Real> boundSpeeds(Particles<Real>& p, Real cap, ShareRange range) {
  KickResult<Real> result;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    Real v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (v2 > cap * cap && p.driver[i] == 0) {
      scaleTo(cap, v2, p.vx[i], p.vy[i], p.vz[i]);
      v2 = cap * cap;
      ++result.speed_clamped;
    }
    result.max_speed2 = std::max(result.max_speed2, v2);
  }
  return result;
}

}  // namespace bleedsim::sph
