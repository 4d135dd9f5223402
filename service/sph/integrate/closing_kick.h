// What ends a step's motion: gravity, the bounds on acceleration and speed, and the closing half kick (kick_drift.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "service/sph/particles.h"
#include "service/sph/quad.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

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
class ClosingKick {
 public:
  using Q = Quad<Real>;
  using V = typename Q::Vector;

  ClosingKick(Particles<Real>& p, Real* acceleration, const std::array<Real, 3>& gravity, Real half_dt,
              const MotionCaps<Real>& caps)
      : p_{p},
        acceleration_{acceleration},
        gravity_{gravity},
        half_dt_{half_dt},
        caps_{caps},
        speed_cap2_{caps.speed * caps.speed},
        acceleration_cap2_{caps.acceleration * caps.acceleration} {}

  KickResult<Real> run(ShareRange range) {
    inFours(
        range.begin, range.end, [this](std::uint32_t i) { return kickFour(i); }, [this](std::uint32_t i) { kickOne(i); });
    result_.max_speed2 = std::max(result_.max_speed2, Q::largest(max_speed2_));
    result_.max_acceleration2 = std::max(result_.max_acceleration2, Q::largest(max_acceleration2_));
    return result_;
  }

 private:
  /// False, and nothing has happened, where one of the four needs more than a kick: it is driven, clamped or not finite.
  bool kickFour(std::uint32_t i) {
    if (!fourZeros(p_.driver.data() + i)) return false;
    Real* a = acceleration_ + std::size_t{i} * 4;
    const V pull{gravity_[0], gravity_[1], gravity_[2], Real(-0.0)};  // x + -0 is x whatever x is
    V rows[4];
    for (std::size_t k = 0; k < 4; ++k) rows[k] = Q::load(a + 4 * k) + pull;
    V ax = rows[0], ay = rows[1], az = rows[2], rate = rows[3];
    Q::transpose(ax, ay, az, rate);
    const V a2 = ax * ax + ay * ay + az * az;
    const V half = Q::set(half_dt_);
    const V vx = Q::load(p_.vx.data() + i) + ax * half;
    const V vy = Q::load(p_.vy.data() + i) + ay * half;
    const V vz = Q::load(p_.vz.data() + i) + az * half;
    const V v2 = vx * vx + vy * vy + vz * vz;
    const V sum = v2 + rate;  // less itself it is 0 if it is finite
    if (!Q::all((a2 <= Q::set(acceleration_cap2_)) & (v2 <= Q::set(speed_cap2_)) & (sum - sum == Q::set(Real(0))))) return false;
    for (std::size_t k = 0; k < 4; ++k) Q::store(rows[k], a + 4 * k);
    Q::store(vx, p_.vx.data() + i);
    Q::store(vy, p_.vy.data() + i);
    Q::store(vz, p_.vz.data() + i);
    max_speed2_ = v2 > max_speed2_ ? v2 : max_speed2_;
    max_acceleration2_ = a2 > max_acceleration2_ ? a2 : max_acceleration2_;
    return true;
  }

  void kickOne(std::uint32_t i) {
    Real* a = acceleration_ + std::size_t{i} * 4;
    Real& vx = p_.vx[i];
    Real& vy = p_.vy[i];
    Real& vz = p_.vz[i];
    if (p_.driver[i] != 0) {
      a[0] = a[1] = a[2] = Real(0);
      result_.max_speed2 = std::max(result_.max_speed2, vx * vx + vy * vy + vz * vz);
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) a[k] += gravity_[k];
    Real a2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    if (a2 > acceleration_cap2_) {
      scaleTo(caps_.acceleration, a2, a[0], a[1], a[2]);
      a2 = acceleration_cap2_;
      ++result_.acceleration_clamped;
    }
    vx += a[0] * half_dt_;
    vy += a[1] * half_dt_;
    vz += a[2] * half_dt_;
    Real v2 = vx * vx + vy * vy + vz * vz;
    if (v2 > speed_cap2_) {
      scaleTo(caps_.speed, v2, vx, vy, vz);
      v2 = speed_cap2_;
      ++result_.speed_clamped;
    }
    // An acceleration that is no number, or infinite, has made v2 one that is not; a[3] is the platelets' rate.
    result_.finite = result_.finite && std::isfinite(v2 + a[3]);
    result_.max_speed2 = std::max(result_.max_speed2, v2);
    result_.max_acceleration2 = std::max(result_.max_acceleration2, a2);
  }

  Particles<Real>& p_;
  Real* acceleration_;
  const std::array<Real, 3>& gravity_;
  Real half_dt_;
  const MotionCaps<Real>& caps_;
  Real speed_cap2_;
  Real acceleration_cap2_;
  KickResult<Real> result_;
  V max_speed2_ = Q::set(Real(0));
  V max_acceleration2_ = Q::set(Real(0));
};

template <class Real>
KickResult<Real> closingKick(Particles<Real>& p, Real* acceleration, const std::array<Real, 3>& gravity, Real half_dt,
                             const MotionCaps<Real>& caps, ShareRange range) {
  return ClosingKick<Real>{p, acceleration, gravity, half_dt, caps}.run(range);
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
