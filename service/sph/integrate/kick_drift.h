// Kick-drift-kick (velocity Verlet): v += a dt/2, x += v dt, new a, v += a dt/2. Time-reversible, so a closed box keeps its
// energy. With the whole kick before the drift and none after it this is symplectic Euler, as the literal model has it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/neighbors/domain_box.h"
#include "service/sph/particles.h"
#include "service/sph/quad.h"
#include "service/sph/share_range.h"
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
class Drift {
 public:
  using Q = Quad<Real>;
  using V = typename Q::Vector;

  Drift(const Particles<Real>& p, Real* moved, const Real* acceleration, Real half_dt, Real dt_per_h, double h,
        const DomainBox<Real>& domain, const WoundSet& wounds, std::uint32_t* cells)
      : p_{p},
        moved_{moved},
        acceleration_{acceleration},
        half_dt_{half_dt},
        dt_per_h_{dt_per_h},
        h_{h},
        domain_{domain},
        wounds_{wounds},
        cells_{cells},
        bounded_{!domain.periodic[0] && !domain.periodic[1] && !domain.periodic[2]} {}

  DriftResult<Real> run(ShareRange range) {
    inFours(
        range.begin, range.end, [this](std::uint32_t i) { return driftFour(i); }, [this](std::uint32_t i) { driftOne(i); });
    Bounds<Real> of_fours;
    for (std::size_t k = 0; k < 3; ++k) {
      of_fours.lower[k] = Q::least(lower_[k]);
      of_fours.upper[k] = Q::largest(upper_[k]);
    }
    result_.bounds.merge(of_fours);
    return result_;
  }

 private:
  /// False, and nothing that counts has happened, where one of the four needs more than a drift.
  bool driftFour(std::uint32_t i) {
    if (!bounded_ || !fourZeros(p_.driver.data() + i)) return false;
    V ax, ay, az, unused;
    Q::loadColumns(acceleration_ + std::size_t{i} * 4, ax, ay, az, unused);
    V x[3] = {drifted(p_.x, p_.vx, ax, i), drifted(p_.y, p_.vy, ay, i), drifted(p_.z, p_.vz, az, i)};
    auto inside = (x[0] >= Q::set(domain_.lower[0])) & (x[0] <= Q::set(domain_.upper[0]));
    for (std::size_t k = 1; k < 3; ++k) inside &= (x[k] >= Q::set(domain_.lower[k])) & (x[k] <= Q::set(domain_.upper[k]));
    if (!Q::all(inside)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      lower_[k] = x[k] < lower_[k] ? x[k] : lower_[k];
      upper_[k] = x[k] > upper_[k] ? x[k] : upper_[k];
    }
    Q::storeColumns(x[0], x[1], x[2], unused, moved_ + std::size_t{i} * 4);
    std::fill_n(cells_ + i, Q::kWidth, 0u);
    return true;
  }

  V drifted(const AlignedArray<Real>& x, const AlignedArray<Real>& v, const V& a, std::uint32_t i) const {
    return Q::load(x.data() + i) + (Q::load(v.data() + i) + a * Q::set(half_dt_)) * Q::set(dt_per_h_);
  }

  void driftOne(std::uint32_t i) {
    cells_[i] = 0;
    Real* position = moved_ + std::size_t{i} * 4;
    if (p_.driver[i] != 0) {
      const Vec3 driven = wounds_.kinematics(p_.driver[i]).position;
      for (int k = 0; k < 3; ++k) position[k] = static_cast<Real>(driven[k] / h_);
    } else {
      const std::array<Real, 3> velocity = kickedVelocity(p_, acceleration_, i, half_dt_);
      position[0] = p_.x[i];
      position[1] = p_.y[i];
      position[2] = p_.z[i];
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        Real& x = position[k];
        x += velocity[k] * dt_per_h_;
        if (domain_.periodic[k]) {
          x = domain_.wrapped(k, x);
        } else {
          inside = inside && x >= domain_.lower[k] && x <= domain_.upper[k];
        }
      }
      if (!inside) {
        cells_[i] = CellGrid<Real>::kRemoved;
        ++result_.left_domain;
        return;
      }
    }
    result_.bounds.include(position[0], position[1], position[2]);
  }

  const Particles<Real>& p_;
  Real* moved_;
  const Real* acceleration_;
  Real half_dt_;
  Real dt_per_h_;
  double h_;
  const DomainBox<Real>& domain_;
  const WoundSet& wounds_;
  std::uint32_t* cells_;
  bool bounded_;
  DriftResult<Real> result_;
  V lower_[3] = {Q::set(result_.bounds.lower[0]), Q::set(result_.bounds.lower[1]), Q::set(result_.bounds.lower[2])};
  V upper_[3] = {Q::set(result_.bounds.upper[0]), Q::set(result_.bounds.upper[1]), Q::set(result_.bounds.upper[2])};
};

/// The opening half kick of particle i, if any, into place `to` of another order; a throat gives its particles their velocities,
/// and frees those that it releases.
template <class Real>
void kickOne(Particles<Real>& sorted, std::uint32_t to, const Particles<Real>& p, std::uint32_t i, const Real* acceleration,
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

/// The places of `length` particles, 4 entries each in `moved`, into those from `to` on.
template <class Real>
void copyPlaces(Particles<Real>& sorted, std::uint32_t to, const Real* moved, std::uint32_t length) {
  using Q = Quad<Real>;
  std::uint32_t k = 0;
  for (; k + Q::kWidth <= length; k += Q::kWidth, moved += 4 * Q::kWidth) {
    typename Q::Vector x, y, z, unused;
    Q::loadColumns(moved, x, y, z, unused);
    Q::store(x, sorted.x.data() + to + k);
    Q::store(y, sorted.y.data() + to + k);
    Q::store(z, sorted.z.data() + to + k);
  }
  for (; k < length; ++k, moved += 4) {
    sorted.x[to + k] = moved[0];
    sorted.y[to + k] = moved[1];
    sorted.z[to + k] = moved[2];
  }
}

/// kickOne() of `length` particles from `from` on, into places from `to` on.
template <class Real>
void kick(Particles<Real>& sorted, std::uint32_t to, const Particles<Real>& p, std::uint32_t from, std::uint32_t length,
          const Real* acceleration, Real half_dt, const WoundSet& wounds) {
  using Q = Quad<Real>;
  using V = typename Q::Vector;
  const V half = Q::set(half_dt);
  for (std::uint32_t k = 0; k < length;) {
    const std::uint32_t i = from + k;
    if (k + Q::kWidth > length || half_dt == Real(0) || !fourZeros(p.driver.data() + i)) {
      const std::uint32_t end = std::min(length, k + Q::kWidth);
      for (; k < end; ++k) kickOne(sorted, to + k, p, from + k, acceleration, half_dt, wounds);
      continue;
    }
    V ax, ay, az, unused;
    Q::loadColumns(acceleration + std::size_t{i} * 4, ax, ay, az, unused);
    Q::store(Q::load(p.vx.data() + i) + ax * half, sorted.vx.data() + to + k);
    Q::store(Q::load(p.vy.data() + i) + ay * half, sorted.vy.data() + to + k);
    Q::store(Q::load(p.vz.data() + i) + az * half, sorted.vz.data() + to + k);
    k += Q::kWidth;
  }
}

}  // namespace bleedsim::sph
