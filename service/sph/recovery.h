// What a world does with a step that did not hold: physics.md section 6, "recovery ladder".
//
//   1  take the step back, halve dt and try again, at most kMostHalvings times     Counter::step_retried, for each
//   2  cap forces: an infinite one keeps its direction                             Counter::infinite_force_capped
//   3  clamp speed                                                                 Counter::speed_clamped
//   4  freeze the offender: a particle whose force is no number stops where it is  Counter::particle_frozen
// When more than half of the free particles would freeze, the world is faulted and shows the state before the step.
//
// What starts it:
// - not_finite: a velocity, an acceleration or the implicit solve is not a finite number.
// - too_long: the motion at the step's end allows less than half of the time that the step took. dt follows from the motion at a
//   step's beginning; what comes suddenly, a blow or a push, is overrun by a step that was chosen in peace. Its halves meet it at
//   a quarter of the depth of penetration and more.
// What does not: an acceleration or a speed beyond its bound. Both are cut in every step (Counter::acceleration_clamped and
// speed_clamped, which is rung 3 too): that is what lets an intruder of 10 c0 or a push of 1 kN live on, shorter steps do not
// make either of them weaker, and would be tried in vain in every step. The bounds are so far out that a step at both of them
// allows a quarter of the acoustic limit.
//
// A healthy step pays for this with a look at three numbers that it has anyway. Nothing is copied: the sort reads the state
// before the step and writes a second one, with the opening kick on the way; the drift puts its places into the second of two
// buffers of accelerations, which the forces of the step's end fill later. So what was before is still there at the end.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "service/sph/integrate/closing_kick.h"
#include "service/sph/world.h"

namespace bleedsim::sph {

enum class Trouble { none, too_long, not_finite };

constexpr int kMostHalvings = 4;
/// Between steps that follow one another dt changes by less than this wherever motion is resolved.
constexpr double kOverrun = 2.0;

/// `allowed`: by the motion that the step of `dt` seconds ended with, s.
inline Trouble troubleOf(bool finite, double dt, double allowed) {
  if (!finite) return Trouble::not_finite;
  return dt > kOverrun * allowed ? Trouble::too_long : Trouble::none;
}

/// What is counted before it is known whether a step holds.
inline constexpr std::array kCountedInAttempts{Counter::neighbor_overflow, Counter::left_domain, Counter::force_without_fluid,
                                               Counter::viscosity_unsolved};

enum class ForceKind { finite, infinite, none };

/// none: it has no direction, or the platelets' rate is no number.
template <class Real>
ForceKind kindOf(const Real* a) {
  if (std::isnan(a[0]) || std::isnan(a[1]) || std::isnan(a[2]) || !std::isfinite(a[3])) return ForceKind::none;
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]) ? ForceKind::finite : ForceKind::infinite;
}

/// Makes an infinite acceleration finite: along the components that are infinite, and beyond the bound, to which the kick cuts
/// it.
template <class Real>
void capInfinite(Real bound, Real* a) {
  for (std::size_t k = 0; k < 3; ++k) a[k] = std::isinf(a[k]) ? std::copysign(2 * bound, a[k]) : Real(0);
}

/// closingKick() that gets along with accelerations that are no numbers: rungs 2 and 4.
template <class Real>
KickResult<Real> guardedKick(Particles<Real>& p, Real* acceleration, const std::array<Real, 3>& gravity, Real half_dt,
                             const MotionCaps<Real>& caps, ShareRange range) {
  KickResult<Real> result;
  ShareRange one = range;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    Real* a = acceleration + std::size_t{i} * 4;
    const ForceKind kind = p.driver[i] == 0 ? kindOf(a) : ForceKind::finite;
    if (p.driver[i] == 0) ++result.free;
    if (kind == ForceKind::none) {
      std::fill_n(a, 4, Real(0));
      p.vx[i] = p.vy[i] = p.vz[i] = Real(0);
      ++result.frozen;
      continue;
    }
    if (kind == ForceKind::infinite) capInfinite(caps.acceleration, a);
    one.begin = i;
    one.end = i + 1;
    KickResult<Real> kick = closingKick(p, acceleration, gravity, half_dt, caps, one);
    if (kind == ForceKind::infinite) {
      kick.capped = 1;
      kick.acceleration_clamped = 0;
    }
    result.merge(kick);
  }
  return result;
}

}  // namespace bleedsim::sph
